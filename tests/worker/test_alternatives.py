"""A number of motions that was scored is answered without a job."""

import json

import pytest

from caesura.core.document import SegmentationDocument
from caesura.worker.alternatives import restore_alternative
from caesura.worker.records import redis_keys
from tests.installation import take_npz

SWITCHING = {"method": "switching"}


def stored(place, record):
    """The alternatives beside a result, once every one is there."""
    document, _, _ = place.records.segmentations.result(record.id)
    scored = SegmentationDocument.model_validate_json(document).scores
    key = redis_keys.alternatives_key(record.id)
    place.until(record.id, lambda _: place.redis.hlen(key) == len(scored))
    return [score.motions for score in scored]


@pytest.fixture(scope="module")
def varied():
    """A take of three motions, long enough for several numbers of them to be scored."""
    return take_npz(order=(0, 1, 2, 0), seconds=4.0)


@pytest.fixture(scope="module")
def unasked(place, varied):
    """A take whose number of motions was not given, done, and its alternatives stored."""
    animation = place.upload(varied)
    done = place.ended(place.submit(animation, **SWITCHING).id)
    return animation, done, stored(place, done)


def test_every_number_that_was_scored_is_stored(unasked):
    """Without anybody's asking for them; and they are not listed as asked for."""
    _, _, scored = unasked
    assert len(scored) > 1


def test_what_is_stored_is_not_listed_until_it_is_asked_for(place, unasked):
    """The animation has one segmentation, and a second one as soon as somebody wants it."""
    animation, done, scored = unasked
    assert [record.id for record in place.records.segmentations.of(animation.id)] == [done.id]
    made = restore_alternative(place.records, place.wanted(animation, motions=scored[0], **SWITCHING), done.id)
    assert {record.id for record in place.records.segmentations.of(animation.id)} == {done.id, made.id}
    place.jobs.delete(made.id)


def test_the_answer_is_the_one_that_a_job_would_give(place, unasked):
    """Byte for byte: document, curve and labels."""
    animation, done, scored = unasked
    wanted = place.wanted(animation, motions=scored[-1], **SWITCHING)
    made = restore_alternative(place.records, wanted, done.id)
    assert (made.status, made.attempt) == ("done", 0)
    told = place.records.segmentations.result(made.id)
    place.jobs.delete(made.id)
    computed = place.ended(place.submit(animation, motions=scored[-1], **SWITCHING).id)
    assert computed.attempt == 1
    assert place.records.segmentations.result(computed.id) == told
    assert (computed.segments, computed.motions, computed.frames) == (made.segments, made.motions, made.frames)
    place.jobs.delete(computed.id)
    assert json.loads(told[0])["energy"] == json.loads(place.records.segmentations.result(done.id)[0])["energy"]


def test_what_was_asked_for_before_stays_as_it_is(place, unasked):
    """A segmentation that is there is not made again of what is stored."""
    animation, done, scored = unasked
    wanted = place.wanted(animation, motions=scored[0], **SWITCHING)
    assert restore_alternative(place.records, wanted, done.id) is not None
    assert restore_alternative(place.records, wanted, done.id) is None
    place.jobs.delete(wanted.id)


def test_a_number_that_was_not_scored_is_not_stored(place, unasked):
    """Then it is a job, as always."""
    animation, done, scored = unasked
    assert (
        restore_alternative(place.records, place.wanted(animation, motions=max(scored) + 1, **SWITCHING), done.id)
        is None
    )


def test_they_go_with_their_result(place, take):
    """Deleted, nothing of it stays, and no late job writes any."""
    done = place.ended(place.submit(place.upload(take), **SWITCHING).id)
    place.jobs.delete(done.id)
    place.redis.delete(redis_keys.alternatives_key(done.id))
    again = place.ended(place.submit(place.upload(take), **SWITCHING).id)
    stored(place, again)  # the worker has come this far: it is past those of the deleted one
    assert not place.redis.exists(redis_keys.alternatives_key(done.id))


def test_a_worker_that_was_told_the_number_stores_none(place, take):
    """Nothing was scored."""
    done = place.ended(place.submit(place.upload(take), motions=2, **SWITCHING).id)
    assert not place.redis.exists(redis_keys.alternatives_key(done.id))
