"""Files made of a result whose job does not end well: it is said why, and the next who asks has it made anew."""

import errno
import os
import signal
import time
from pathlib import Path

import numpy as np
import pytest

from caesura.worker.queue.auxiliary_jobs import PROBLEM_SECONDS, submit_export
from caesura.worker.queue.job_problems import problem_of
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import redis_keys
from tests.glb import moving_square
from tests.installation import descendants

SEPARATE = "clips?files=separate"


@pytest.fixture(scope="module")
def result(place):
    """A result whose clips, in files of their own, take seconds to pack: each holds a picture of 60 MB."""
    model = moving_square()
    picture = model.view(np.random.default_rng(1).bytes(60_000_000))
    model.json["images"] = [{"bufferView": picture, "mimeType": "image/png"}]
    model.json["textures"] = [{"source": 0}]
    model.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    model.json["meshes"][0]["primitives"][0]["material"] = 0
    return place.ended(place.submit(place.upload(model.glb()), fps=200).id)


def ended(place, identifier, form, seconds=30.0):
    """The export once it is made, or there is a reason why not."""
    deadline = time.monotonic() + seconds
    while (made := place.records.exports.one(identifier, form)) is None or made.pending:
        assert time.monotonic() < deadline, made
        time.sleep(0.02)
    return made


def working(place):
    """The processes that run a job now."""
    pids = [pid for _, pid in descendants(place.pool.process.pid)]
    return [pid for pid in pids if comm(pid) == "horse: working\n"]


def comm(pid):
    """The name of a process, empty once it is gone."""
    try:
        return Path(f"/proc/{pid}/comm").read_text()
    except OSError:
        return ""


def until(place, *, busy):
    """The processes that run a job, once there are some or none."""
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        if bool(pids := working(place)) == busy:
            return pids
        time.sleep(0.02)
    raise TimeoutError("no job runs" if busy else "a job runs on")


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="only Linux names its processes there")
def test_an_export_whose_process_is_killed_is_said_to_be(place, result):
    """At once, as long as everybody who waits needs to hear it; asked for later, it is made."""
    until(place, busy=False)  # the job that made the result may not have left yet
    assert submit_export(place.jobs, result.id, SEPARATE).pending
    (export,) = until(place, busy=True)
    os.kill(export, signal.SIGKILL)
    killed = ended(place, result.id, SEPARATE, 10.0)
    assert killed.problem["code"] == "worker-killed"
    assert submit_export(place.jobs, result.id, SEPARATE) == killed
    earlier = killed.model_copy(update={"created": time.time() - PROBLEM_SECONDS})
    place.records.exports.write(result.id, SEPARATE, earlier)
    assert submit_export(place.jobs, result.id, SEPARATE).pending
    assert ended(place, result.id, SEPARATE).key


def test_an_export_that_takes_too_long_is_said_to(place, result):
    """A problem of its own, not a fault of ours: the setting that a job's time is."""
    form = f"{SEPARATE}&origin=keep"
    hasty = Jobs(place.redis, 3, 1)
    assert submit_export(hasty, result.id, form).pending
    problem = ended(place, result.id, form).problem
    assert (problem["code"], problem["setting"]) == ("out-of-time", "CAESURA_JOB_SECONDS")


def test_an_export_whose_worker_is_lost_is_made_anew(idle, take):
    """Pending as long as its job waits or runs; once neither is so, whoever asks has another one."""
    record = idle.submit(idle.upload(take))
    first = submit_export(idle.jobs, record.id, "npz")
    idle.redis.delete(redis_keys.lease_key(first.token))
    assert submit_export(idle.jobs, record.id, "npz") == first  # it waits
    idle.redis.delete(idle.jobs.queues.key("cut"))
    idle.jobs.records.attempts.renew(first.token)
    assert submit_export(idle.jobs, record.id, "npz") == first  # it runs
    idle.redis.delete(redis_keys.lease_key(first.token))
    assert submit_export(idle.jobs, record.id, "npz").token not in {"", first.token}


def test_a_full_disk_is_no_fault_of_ours():
    """ENOSPC while a file is made; any other trouble with a file is the store's."""
    assert problem_of(OSError(errno.ENOSPC, "No space left on device"))["code"] == "storage-full"
    assert problem_of(OSError(errno.EIO, "Input/output error"))["code"] == "storage-unavailable"
    assert problem_of(KeyError("a bug"))["code"] == "internal-error"
