"""How nothing is stuck: live segmentations that nobody works on are found and tried again."""

import time

from caesura.worker.queue.job_problems import LOST
from caesura.worker.queue.jobs import LONGEST_PAUSE_SECONDS, Jobs
from caesura.worker.records.record_types import SegmentationRecord


class OrphanedJobWatch:
    """Looks every few seconds, and remembers what it missed. Any number of processes may watch."""

    def __init__(self, jobs: Jobs) -> None:
        self._jobs = jobs
        self._missed: set[str] = set()

    def look(self) -> int:
        """Try again what is lost, and answer how many those are; what has paused long enough gets its place.

        Lost is what runs without a lease, or is queued without a place in a queue, at two looks in a row: one alone
        may be a clock that jumped, or a job on its way from the queue to its worker.
        """
        live = self._jobs.records.segmentations.live()
        for paused in (record for record in live if _pause_is_over(record)):
            self._jobs.resume(paused.id, paused.token)
        missing = {r.token: r.id for r in live if not r.due and not _has_worker(self._jobs, r)}
        lost = missing.keys() & self._missed
        self._missed = missing.keys() - lost
        return sum(self._jobs.retry(missing[token], token, LOST) is not None for token in lost)


def retry_jobs_after_restart(jobs: Jobs) -> int:
    """Try again all that an embedded server held when it ended, and answer how many that are.

    No worker can be alive at its start: whatever was running is lost, and every pause is over.
    """
    live = jobs.records.segmentations.live()
    for paused in (record for record in live if record.due):
        jobs.resume(paused.id, paused.token)
    lost = [r for r in live if not r.due and (r.status == "running" or not _has_worker(jobs, r))]
    return sum(jobs.retry(record.id, record.token, LOST) is not None for record in lost)


def _pause_is_over(record: SegmentationRecord) -> bool:
    """One longer than any pause is a clock that jumped: that is over too."""
    return bool(record.due) and not 0 < record.due - time.time() <= LONGEST_PAUSE_SECONDS


def _has_worker(jobs: Jobs, record: SegmentationRecord) -> bool:
    """Whether it has a worker that lives, or a place in its queue."""
    if record.status == "running":
        return jobs.records.attempts.leased(record.token)
    return jobs.queues.position(record) is not None
