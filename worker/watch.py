"""How nothing is stuck: somebody looks, every few seconds, for live segmentations that nobody works on."""

import time

from worker.jobs import Jobs
from worker.pauses import LONGEST_PAUSE_SECONDS
from worker.problems import LOST
from worker.schema import SegmentationRecord


class Watch:
    """What one process remembers of the look before. Any number of processes may watch."""

    def __init__(self, jobs: Jobs) -> None:
        self._jobs = jobs
        self._missed: set[str] = set()

    def reconcile(self, everything_started_is_lost: bool = False) -> int:
        """Find live segmentations that nobody works on and try them again; answers how many.

        Running without a lease, or queued without a place in a queue, at two calls in a row: one alone may be
        a clock that jumped, or a job on its way from the queue to its worker. Call every few seconds; any number
        of processes may. At the start of an embedded server no worker can be alive: then one call settles all.
        Those whose pause is over get their place in the queue.
        """
        live = self._jobs.records.segmentations.live()
        for paused in (record for record in live if record.due):
            self._resume(paused, at_once=everything_started_is_lost)
        live = [record for record in live if not record.due]
        missing = {record.token: record for record in live if not self._attended(record)}
        if everything_started_is_lost:
            missing = {r.token: r for r in live if r.status == "running" or not self._attended(r)}
        lost = set(missing) if everything_started_is_lost else set(missing) & self._missed
        self._missed = set(missing) - lost
        return sum(self._jobs.again(missing[token].id, token, LOST) is not None for token in lost)

    def _resume(self, paused: SegmentationRecord, at_once: bool) -> None:
        """Queue it where its pause is over. One longer than any pause is a clock that jumped: that is over too."""
        left = paused.due - time.time()
        if at_once or left <= 0 or left > LONGEST_PAUSE_SECONDS:
            self._jobs.resume(paused.id, paused.token)

    def _attended(self, record: SegmentationRecord) -> bool:
        if record.status == "running":
            return self._jobs.records.attempts.leased(record.token)
        return self._jobs.queues.position(record) is not None
