"""What a killed process leaves behind is found and cleared; what somebody still writes is not."""

import os
import signal
import subprocess
import sys
import time

import pytest

from caesura.worker.queue.auxiliary_jobs import submit_export
from caesura.worker.records import redis_keys
from caesura.worker.records.schema import AnalysisRecord, ExportRecord
from caesura.worker.retention.deletion import delete_segmentation
from caesura.worker.retention.orphaned_blobs import delete_orphaned_blobs
from caesura.worker.retention.retention import sweep
from caesura.worker.store.temporary_files import delete_abandoned_files, file_path, temporary_file

HOLD = """
import sys, time
from pathlib import Path
from caesura.worker.retention.deletion import delete_segmentation
from caesura.worker.store.temporary_files import locked_temporary_file
file = locked_temporary_file(Path(sys.argv[1]))
file.write(b"half of it")
print("held", flush=True)
time.sleep(60)
"""


def test_a_file_is_cleared_once_its_writer_was_killed(tmp_path):
    """Not before, however old it is; no clock is asked."""
    writer = subprocess.Popen([sys.executable, "-c", HOLD, str(tmp_path)], stdout=subprocess.PIPE, text=True)
    writer.stdout.readline()
    for path in tmp_path.iterdir():
        os.utime(path, (0, 0))
    assert delete_abandoned_files(tmp_path) == 0
    writer.send_signal(signal.SIGKILL)
    writer.wait()
    writer.stdout.close()
    assert delete_abandoned_files(tmp_path) == 1
    assert not list(tmp_path.iterdir())


def test_a_file_that_was_moved_to_its_place_stays(tmp_path):
    """It is whole by then; one that was not is gone."""
    with temporary_file(tmp_path) as kept:
        kept.write(b"whole")
        file_path(kept).rename(tmp_path / "kept")
    with temporary_file(tmp_path) as broken:
        broken.write(b"half")
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert delete_abandoned_files(tmp_path) == 0
    assert delete_abandoned_files(tmp_path / "not-there") == 0


def test_a_blob_on_its_way_is_in_no_list(tmp_path, idle):
    """Written aside and moved: the store holds whole blobs only."""

    def pieces():
        yield b"first"
        assert list(idle.blobs.all()) == []
        yield b"second"

    key = idle.blobs.put(pieces(), "viewer")
    assert list(idle.blobs.all()) == [(key, 11)]
    assert idle.blobs.read(key) == b"firstsecond"
    assert not list(idle.settings.scratch_dir.glob("*.part"))


def test_a_blob_that_nothing_points_to_goes_at_the_second_look(idle, take):
    """The first look only notes it: it may be a running job's. What is pointed to stays, and is counted."""
    animation = idle.upload(take)
    lost = idle.blobs.put(b"killed before it was told", "analyses")
    assert delete_orphaned_blobs(idle.records, idle.blobs, 0.0) == {"uploads": len(take), "analyses": 25}
    assert delete_orphaned_blobs(idle.records, idle.blobs, 3600.0)["analyses"] == 25
    assert delete_orphaned_blobs(idle.records, idle.blobs, 0.0) == {"uploads": len(take)}
    assert [key for key, _ in idle.blobs.all()] == [animation.parts[0].key]
    assert lost.encode() not in idle.redis.hkeys(redis_keys.ORPHAN_CANDIDATES_KEY)


def test_a_clock_that_jumps_loses_no_blob(idle):
    """Forward by a year between being kept and the first look, or back: one look never deletes."""
    fresh = idle.blobs.put(b"a running job's", "analyses")
    os.utime(idle.settings.data_dir / "blobs" / fresh, (0, 0))
    delete_orphaned_blobs(idle.records, idle.blobs, 3600.0)
    idle.redis.hset(redis_keys.ORPHAN_CANDIDATES_KEY, fresh, repr(time.time() + 1e7))
    delete_orphaned_blobs(idle.records, idle.blobs, 3600.0)
    assert [key for key, _ in idle.blobs.all()] == [fresh]


SWEEP = """
import os, signal, sys
from caesura.worker.store.blobs import Blobs
from caesura.worker.queue.jobs import Jobs
from caesura.worker.retention.retention import sweep
from caesura.worker.settings import WorkerSettings
settings, left = WorkerSettings(), int(sys.argv[1])

class Fragile(Blobs):
    def delete(self, key):
        global left
        if not left:
            os.kill(os.getpid(), signal.SIGKILL)
        left -= 1
        super().delete(key)

sweep(Jobs.open(settings), Fragile.open(settings.store_location, settings.scratch_dir), 0.0, 0.0)
"""


@pytest.mark.parametrize("deletions", range(3))
def test_a_sweep_that_is_killed_leaves_no_orphan(idle, take, deletions):
    """Killed after any number of deletions: the next one ends what it began, and nothing of it stays anywhere."""
    animation = idle.upload(take)
    analysis = idle.blobs.put(b"analysis", "analyses")
    idle.records.analyses.add(animation.id, "digest", AnalysisRecord(key=analysis))
    env = {**os.environ, **idle.settings.environment()}
    ended = subprocess.run([sys.executable, "-c", SWEEP, str(deletions)], check=False, env=env)
    assert ended.returncode == (-signal.SIGKILL if deletions < 2 else 0)
    sweep(idle.jobs, idle.blobs, 0.0, 0.0, 0.0)
    assert list(idle.blobs.all()) == []
    assert not [key for key in idle.redis.scan_iter() if animation.id.encode() in key]


def test_a_file_made_of_what_was_deleted_meanwhile_is_kept_nowhere(idle, take):
    """The job that made it learns that nobody points to it any more."""
    record = idle.submit(idle.upload(take))
    made = ExportRecord(key="exports/x")
    submit_export(idle.jobs, record.id, "npz")
    assert idle.records.exports.write(record.id, "npz", made)
    delete_segmentation(idle.jobs, idle.blobs, record.id)
    assert not idle.records.exports.write(record.id, "npz", made)
    assert idle.records.exports.one(record.id, "npz") is None
