"""Deleting while others ask: whatever comes first, nothing is left that nobody would delete any more."""

import threading
import time
from contextlib import suppress

import pytest

from caesura.worker.queue.auxiliary_jobs import submit_export
from caesura.worker.records import redis_keys
from caesura.worker.records.segmentations import AnimationDeleted
from caesura.worker.retention.deletion import delete_animation, delete_segmentation
from caesura.worker.retention.sweep import sweep, sweep_by_clock


def left(place, *identifiers):
    """Keys of Redis, and blobs, that speak of them."""
    keys = [key for key in place.redis.scan_iter(count=1000) if any(i.encode() in key for i in identifiers)]
    return keys, [key for key, _ in place.blobs.all()]


def test_nothing_is_queued_of_what_has_gone(idle, take):
    """The file was deleted between its upload and its order: that is said, and no record is kept."""
    animation = idle.upload(take)
    delete_animation(idle.jobs, idle.blobs, animation)
    with pytest.raises(AnimationDeleted) as refused:
        idle.submit(animation)
    assert refused.value.code == "animation-deleted"
    assert left(idle, animation.id, idle.wanted(animation).id) == ([], [])
    assert idle.jobs.queues.depths() == {"analyse": 0, "cut": 0}


def test_what_is_queued_while_its_animation_is_deleted_goes_with_it(idle, take, monkeypatch):
    """The order comes when all is deleted but the record of the upload: it is deleted too."""
    animation, late = idle.upload(take), []
    delete = idle.records.animations.delete

    def delayed(record):
        if not late:
            late.append(idle.submit(animation))
        return delete(record)

    monkeypatch.setattr(idle.records.animations, "delete", delayed)
    delete_animation(idle.jobs, idle.blobs, animation)
    assert late
    assert left(idle, animation.id, late[0].id) == ([], [])
    assert not idle.records.segmentations.live()


def test_what_is_queued_while_its_animation_is_swept_is_told(idle, take, monkeypatch):
    """The sweep has deleted the files when the order comes: the order stays, and its job will say why it has none."""
    animation, late = idle.upload(take), []
    delete = idle.records.animations.delete

    def delayed(record):
        late.append(idle.submit(animation))
        return delete(record)

    monkeypatch.setattr(idle.records.animations, "delete", delayed)
    sweep(idle.jobs, idle.blobs, -1.0, 1e9)
    assert idle.records.segmentations.one(late[0].id).live
    assert idle.records.animations.one(animation.id).parts == ()


def test_no_file_is_made_of_what_has_gone(idle, take):
    """Asked for in the moment of the delete: it is not found, and nothing is remembered of it."""
    record = idle.submit(idle.upload(take))
    delete_segmentation(idle.jobs, idle.blobs, record.id)
    assert submit_export(idle.jobs, record.id, "npz").problem["code"] == "not-found"
    assert left(idle, record.id)[0] == []


def test_deleting_and_asking_at_once_leaves_all_or_nothing(idle, take):
    """Three ask again and again while one deletes and uploads anew: after the last delete there is not a key."""
    animation = idle.upload(take)
    over = threading.Event()

    def ask():
        while not over.is_set():
            with suppress(AnimationDeleted):
                idle.submit(animation, motions=2)
            over.wait(0.005)

    asking = [threading.Thread(target=ask) for _ in range(3)]
    for thread in asking:
        thread.start()
    for _ in range(10):
        delete_animation(idle.jobs, idle.blobs, animation)
        idle.records.animations.add(animation)
    over.set()
    for thread in asking:
        thread.join()
    delete_animation(idle.jobs, idle.blobs, animation)
    assert left(idle, animation.id, idle.wanted(animation, motions=2).id)[0] == []
    assert idle.jobs.queues.depths() == {"analyse": 0, "cut": 0}


def written(idle):
    """All that the server's append-only file says."""
    while True:
        with suppress(FileNotFoundError):  # it was written anew between the list and the look
            return b"".join(path.read_bytes() for path in (idle.settings.data_dir.parent / "redis").rglob("*.aof"))


def test_names_of_what_was_deleted_leave_redis_with_the_next_sweep(idle, take):
    """Its append-only file keeps what was written until it is written anew; without a deletion it is not."""
    animation = idle.upload(take)
    named = animation.model_copy(update={"name": "secret-dance"})
    idle.redis.set(redis_keys.animation_key(animation.id), named.model_dump_json())
    assert idle.redis.delete(redis_keys.DELETED_KEY) == 0
    delete_animation(idle.jobs, idle.blobs, named)
    idle.redis.execute_command("WAITAOF", 1, 0, 2000)
    assert b"secret-dance" in written(idle)
    sweep_by_clock(idle.jobs, idle.blobs, 1e9, 1e9, time.time())
    deadline = time.monotonic() + 20
    while b"secret-dance" in written(idle):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert not idle.redis.exists(redis_keys.DELETED_KEY)


def test_a_redis_that_may_not_be_told_to_rewrite_is_asked_again(idle, take, caplog):
    """A managed one, or one whose operator forbids the command: the sweep goes on, says so, and asks the next time."""
    delete_animation(idle.jobs, idle.blobs, idle.upload(take))
    idle.redis.execute_command("ACL", "SETUSER", "default", "-bgrewriteaof")
    sweep_by_clock(idle.jobs, idle.blobs, 1e9, 1e9, time.time())
    assert "the names of deleted data stay" in caplog.text
    assert idle.redis.exists(redis_keys.DELETED_KEY)
