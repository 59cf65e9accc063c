"""What a client is told where too much waits already."""

import pytest

from tests.service.conftest import with_its_own_redis


@pytest.fixture(scope="module")
def crowded(checkout, tmp_path_factory):
    """A service without workers that lets one job wait."""
    folder = tmp_path_factory.mktemp("crowded")
    with with_its_own_redis(checkout, folder, workers=False, max_queued=1) as running:
        yield running


def test_one_too_many_is_refused_and_told_when_to_come_back(crowded, take):
    """The first waits and is answered again; another is refused before its file is received, and leaves nothing."""
    first = crowded.http.post("/v1/segmentations", content=take(701))
    assert first.status_code == 202
    before = crowded.http.get("/v1/animations").json()["animations"]
    refused = crowded.http.post("/v1/segmentations", content=take(702))
    assert (refused.status_code, refused.json()["code"]) == (503, "queue-full")
    assert int(refused.headers["Retry-After"]) > 0
    assert refused.json()["setting"] == "CAESURA_MAX_QUEUED"
    assert crowded.http.get("/v1/animations").json()["animations"] == before
    again = crowded.http.post("/v1/segmentations", json={"animation": first.json()["animation"]})
    assert again.json()["id"] == first.json()["id"]
    crowded.http.delete(f"/v1/segmentations/{first.json()['id']}")
    assert crowded.http.post("/v1/segmentations", content=take(702)).status_code == 202
