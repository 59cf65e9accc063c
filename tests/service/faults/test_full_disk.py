"""A disk that fills to the last byte: nothing is lost, it is said in a sentence, and deleting makes room again."""

import io
import time
import zipfile

import numpy as np
import pytest

from benchmarks.chaos.disk import small_disk
from tests.conftest import unavailable
from tests.glb import strip_of_two_motions
from tests.service.conftest import with_its_own_redis

MB = 2**20
MIN_FREE = 8 * MB


@pytest.fixture(scope="module")
def disk(tmp_path_factory):
    """A disk of 28 MB; nothing is mounted where the system does not allow it."""
    folder = tmp_path_factory.mktemp("disk")
    try:
        with small_disk(folder, 28 * MB) as disk:
            yield disk
    except PermissionError as refused:
        unavailable(str(refused))


@pytest.fixture(scope="module")
def small(checkout, disk):
    """A service with all it has on the small disk."""
    with with_its_own_redis(checkout, disk.folder, True, min_free_bytes=MIN_FREE, requests_a_minute=10_000) as running:
        yield running


def strip_with_picture(size):
    """A strip that nods and widens, with an image of random bytes on it."""
    model = strip_of_two_motions()
    picture = model.view(np.random.default_rng(size).bytes(size))
    model.json["images"] = [{"bufferView": picture, "mimeType": "image/png"}]
    model.json["textures"] = [{"source": 0}]
    model.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    model.json["meshes"][0]["primitives"][0]["material"] = 0
    return model.glb()


def done(service, content, **parameters):
    """The status document of a take that is segmented."""
    answer = service.http.post("/v1/segmentations", content=content, params=parameters, headers={"Prefer": "wait=30"})
    assert answer.status_code == 200, answer.text
    return answer.json()


def until(service, expected, method, path, **request):
    """The first answer with one of the codes; all before are of a moment in which nobody knew."""
    deadline = time.monotonic() + 20
    while (answer := service.http.request(method, path, **request)).status_code not in expected:
        assert time.monotonic() < deadline, (answer.status_code, answer.text)
        time.sleep(0.2)
    return answer


def test_an_export_leaves_free_what_must_stay_free(small, disk):
    """Clips that hold the picture once each would not fit: 507, and no piece of the file that was begun is left."""
    made = done(small, strip_with_picture(7 * MB), motions=2)
    before = disk.free
    answer = small.http.get(f"{made['links']['clips']}?files=separate", headers={"Prefer": "wait=30"})
    assert (answer.status_code, answer.json()["code"]) == (507, "storage-full")
    assert "CAESURA_MIN_FREE_BYTES" in answer.text
    assert disk.free == pytest.approx(before, abs=MB)
    light = small.http.get(
        f"{made['links']['clips']}?files=separate&animation_only=true", headers={"Prefer": "wait=30"}
    )
    assert len(zipfile.ZipFile(io.BytesIO(light.content)).namelist()) >= 2
    assert small.http.delete(f"/v1/animations/{made['animation']}").status_code == 204


def test_on_a_full_disk_deleting_makes_room(small, disk, take):
    """Redis takes no writes: 507 for exports, 503 for uploads, reads go on; an upload can be deleted, and all works."""
    large, kept = done(small, strip_with_picture(MB), motions=2), done(small, take(61))
    disk.fill()
    try:
        small.http.get(kept["links"]["plot"].replace("svg", "png"))  # Redis may learn by this one that its disk is full
        assert until(small, {507}, "GET", f"{kept['links']['self']}/result.npz").json()["code"] == "storage-full"
        assert until(small, {507}, "DELETE", kept["links"]["self"]).json()["code"] == "storage-full"
        assert small.http.get(kept["links"]["result"]).status_code == 200
        assert until(small, {503}, "GET", "/readyz").json()["code"] == "not-ready"
        assert small.http.post("/v1/segmentations", content=take(62)).status_code == 503
        assert small.http.delete(f"/v1/animations/{large['animation']}").status_code == 204
        assert small.http.get(large["links"]["self"]).status_code == 404
        assert small.http.delete(kept["links"]["self"]).status_code == 204
    finally:
        disk.empty()
    assert until(small, {200, 202}, "POST", "/v1/segmentations", content=take(62))
