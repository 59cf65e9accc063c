"""Uploads and analyses go some days after their last use, results some days after they were made."""

import pytest

from caesura.worker.queue.auxiliary_jobs import submit_sweep_if_due
from caesura.worker.records import record_types, redis_keys
from caesura.worker.records.collection_types import CollectionRecord, TakeNumbers, TakeRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.retention.sweep import sweep

LONG = 1e9


@pytest.fixture
def done(place, take):
    """A take that is cut."""
    animation = place.upload(take)
    return animation, place.ended(place.submit(animation).id)


def files(place, animation, cut):
    """Which of its blobs are there."""
    folder = place.settings.data_dir / "blobs"
    return [key for key in (animation.parts[0].key, *cut.analysis.blobs()) if (folder / key).exists()]


def test_what_is_in_use_stays(place, done):
    """Nothing is old: nothing goes."""
    sweep(place.jobs, place.blobs, LONG, LONG)
    assert len(files(place, *done)) == 4
    assert place.records.segmentations.one(done[1].id) == done[1]


def test_an_unused_upload_goes_before_its_results(place, done, take):
    """Its result is still read; a new cut needs the file again; and the same bytes may come again."""
    animation, cut = done
    place.redis.zadd(redis_keys.LAST_USED_KEY, {animation.id: 0})
    sweep(place.jobs, place.blobs, 3600, LONG)
    assert files(place, *done) == []
    assert place.records.segmentations.result(cut.id)[0] is not None
    assert place.ended(place.submit(animation, motions=2).id).problem["code"] == "animation-deleted"
    again = animation.model_copy(
        update={"parts": (record_types.Part(name="", key=place.blobs.put(take, "uploads"), bytes=1),)}
    )
    assert place.records.animations.add(again) == (again, True)
    assert place.ended(place.submit(animation, motions=2).id).status == "done"


def test_use_is_what_counts(place, done):
    """To ask for another cut is a use, and what is queued keeps its upload."""
    animation, _ = done
    place.redis.zadd(redis_keys.LAST_USED_KEY, {animation.id: 0})
    assert place.ended(place.submit(animation, motions=2).id).status == "done"
    sweep(place.jobs, place.blobs, 3600, LONG)
    assert len(files(place, *done)) == 4


def test_an_old_result_goes_and_the_record_with_the_last_one(place, done):
    """Nothing of it stays: no blob, no key."""
    animation, cut = done
    place.redis.zadd(redis_keys.LAST_USED_KEY, {animation.id: 0})
    kept = place.records.segmentations.one(cut.id).with_changes(updated=0.0)
    place.redis.set(redis_keys.segmentation_key(cut.id), kept.model_dump_json())
    sweep(place.jobs, place.blobs, 3600, LONG / 1e3)
    assert files(place, *done) == []
    assert not [key for key in place.redis.scan_iter() if animation.id.encode() in key or cut.id.encode() in key]


def collected(place, animation, cut, identifier="c" * 24, updated=1e9):
    """A collection of the take, which was changed last at `updated`."""
    key = place.blobs.put(b"numbers", "collections")
    record = CollectionRecord(id=identifier, owner="", name="all", created=updated, updated=updated)
    place.records.collections.create(record)
    take = TakeRecord(
        animation=animation.id, segmentation=cut.id, name="take", added=1.0, status="labelled",
        numbers=TakeNumbers(poses=key),
    )  # fmt: skip
    place.records.collections.change(identifier, lambda kept: CollectionChange(kept, (take,)))
    return place.settings.data_dir / "blobs" / key


def test_an_unused_upload_takes_its_numbers_out_of_collections(place, done):
    """Its segments stay there."""
    file = collected(place, *done, updated=2e12)
    place.redis.zadd(redis_keys.LAST_USED_KEY, {done[0].id: 0})
    sweep(place.jobs, place.blobs, 3600, LONG)
    assert not file.exists()
    (take,) = place.records.collections.takes("c" * 24, [done[0].id])
    assert (take.status, take.numbers) == ("labelled", None)


def test_a_collection_that_nobody_changes_goes_with_all_that_it_holds(place, done):
    """And one that is in use keeps its files, whatever the sweep finds."""
    old, fresh = collected(place, *done), collected(place, *done, identifier="d" * 24, updated=2e12)
    sweep(place.jobs, place.blobs, LONG, LONG / 10, doubt_seconds=0)
    sweep(place.jobs, place.blobs, LONG, LONG / 10, doubt_seconds=0)
    assert (old.exists(), fresh.exists()) == (False, True)
    assert place.records.collections.one("c" * 24) is None
    assert place.records.collections.with_animation(done[0].id) == ["d" * 24]
    assert not [key for key in place.redis.scan_iter() if b"c" * 24 in key]


def test_a_sweep_is_queued_once_an_hour(idle):
    """However many processes ask."""
    submit_sweep_if_due(idle.jobs)
    submit_sweep_if_due(idle.jobs)
    assert idle.jobs.queues.depths()["cut"] == 1
