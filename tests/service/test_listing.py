"""All segmentations are listed, by state, animation and time; the status says when it was what, and how far it is."""

from datetime import UTC, datetime, timedelta

import pytest

from caesura.service.response_documents import StatusDocument
from caesura.worker.queue.overall_progress import STAGE_SHARES, overall_fraction, remaining_seconds
from caesura.worker.records.record_types import SegmentationRecord
from tests.service.conftest import with_its_own_redis


@pytest.fixture(scope="module")
def queue(checkout, tmp_path_factory, take):
    """A service without workers, with five segmentations of two animations, of which one is cancelled."""
    with with_its_own_redis(checkout, tmp_path_factory.mktemp("listing"), workers=False) as running:
        made = [
            running.http.post(f"/v1/segmentations?motions={motions}", content=take(6100 + seed)).json()
            for seed, motions in ((0, 2), (0, 3), (1, 2), (1, 3), (1, 4))
        ]
        running.http.delete(made[1]["links"]["self"])
        yield running, made


def ids(queue, query=""):
    """The ids of a list, and the address of its next page."""
    page = queue[0].http.get(f"/v1/segmentations{query}").json()
    return [one["id"] for one in page["segmentations"]], page["next"]


def test_all_are_listed_newest_first(queue):
    """Whatever animation they are of."""
    assert ids(queue) == ([one["id"] for one in queue[1]][::-1], None)


def test_a_list_can_be_of_one_state_and_one_animation(queue):
    """Or of both; of an animation that is not there it is refused."""
    made = [one["id"] for one in queue[1]]
    assert ids(queue, "?status=cancelled") == ([made[1]], None)
    assert ids(queue, f"?animation={queue[1][0]['animation']}") == ([made[1], made[0]], None)
    assert ids(queue, f"?animation={queue[1][0]['animation']}&status=queued") == ([made[0]], None)
    assert queue[0].http.get("/v1/segmentations?animation=nothing").status_code == 404


def test_a_list_can_begin_at_a_time(queue):
    """The time itself included; one without a zone is UTC."""
    made = queue[1]
    since = made[2]["created"]
    assert ids(queue, f"?since={since}")[0] == [one["id"] for one in made[:1:-1]]
    for number, one in enumerate(made):
        assert len(ids(queue, f"?since={one['created']}")[0]) == len(made) - number
    assert ids(queue, f"?since={since.rstrip('Z')}")[0] == [one["id"] for one in made[:1:-1]]
    assert ids(queue, f"?since={(datetime.now(UTC) + timedelta(hours=1)).isoformat().replace('+', '%2B')}") == (
        [],
        None,
    )


def test_pages_follow_each_other_with_their_filters(queue):
    """`next` leads through all that are wanted, each once."""
    found, more = ids(queue, "?status=queued&limit=1&since=2020-01-01T00:00:00Z")
    while more:
        page, more = ids(queue, more.removeprefix("/v1/segmentations"))
        found += page
    assert found == [one["id"] for index, one in enumerate(queue[1]) if index != 1][::-1]


def test_a_deleted_one_is_listed_no_more(queue, take):
    """Neither under its animation nor among all."""
    gone = queue[0].http.post("/v1/segmentations", content=take(6109)).json()
    queue[0].http.delete(gone["links"]["self"])
    queue[0].http.delete(gone["links"]["self"])
    assert gone["id"] not in ids(queue)[0]


def test_the_times_of_a_segmentation_are_told(service, take):
    """RFC 3339 in UTC: made, begun, over, in this order."""
    before = datetime.now(UTC)
    made = service.http.post("/v1/segmentations?motions=3", content=take(6110), headers={"Prefer": "wait=30"}).json()
    times = [datetime.fromisoformat(made[name]) for name in ("created", "started", "finished")]
    assert before <= times[0] <= times[1] <= times[2] <= datetime.now(UTC)
    assert made["progress"] == {"stage": "", "fraction": 1.0, "overall": 1.0, "remaining_seconds": None}
    renamed = service.http.patch(f"/v1/animations/{made['animation']}", json={"name": "other"})
    assert renamed.status_code == 200
    again = service.http.get(made["links"]["self"]).json()
    assert again["finished"] == made["finished"]


def running(stage, fraction, began=100.0, updated=130.0):
    return SegmentationRecord(
        id="i", animation="a", parameters={}, algorithm="1", status="running", stage=stage, fraction=fraction,
        created=90.0, started=began, updated=updated,
    )  # fmt: skip


def test_progress_over_all_stages_never_goes_back():
    """From stage to stage in their order, 0 to 1."""
    steps = [overall_fraction(running(stage, part)) for stage in STAGE_SHARES for part in (0.0, 0.5, 1.0)]
    assert steps == sorted(steps)
    assert steps[0] == 0
    assert steps[-1] == pytest.approx(1)
    assert overall_fraction(running("another", 0.5)) == 0


def test_the_rest_is_estimated_from_what_is_done():
    """Half done in 30 s leaves 30 s; before anything is done, and by a clock that went back, there is no estimate."""
    half = running("strain", (0.5 - STAGE_SHARES["read"] - STAGE_SHARES["rest shape"]) / STAGE_SHARES["strain"])
    assert remaining_seconds(half) == pytest.approx(30.0)
    assert remaining_seconds(running("read", 0.1)) is None
    assert remaining_seconds(running("cut", 0.5, updated=90.0)) is None
    assert StatusDocument.of(half).progress.overall == pytest.approx(0.5)
