"""Keeping for so long and no longer: uploads and analyses since their last use, results since they were made."""

import time

from worker.blobs import Blobs
from worker.forgetting import forget_files, forget_segmentation
from worker.jobs import Jobs
from worker.orphans import forget_orphans
from worker.schema import AnimationRecord

DOUBT_SECONDS = 3600.0
"""A blob that no record points to may be a job's that is not done yet; see `worker.orphans`."""


def sweep(
    jobs: Jobs, blobs: Blobs, keep_upload: float, keep_result: float, doubt_seconds: float = DOUBT_SECONDS
) -> None:
    """Forget uploads and analyses unused for `keep_upload` seconds, results `keep_result` seconds old, and orphans.

    What is queued or running keeps its upload. A record goes with the last thing that it is the record of.
    """
    now = time.time()
    for identifier, used in jobs.records.animations.uses().items():
        animation = jobs.records.animations.one(identifier)
        if animation is not None:
            _sweep_animation(jobs, blobs, animation, used < now - keep_upload, now - keep_result)
    forget_orphans(jobs.records, blobs, doubt_seconds)


def _sweep_animation(jobs: Jobs, blobs: Blobs, animation: AnimationRecord, unused: bool, oldest: float) -> None:
    cuts = jobs.records.segmentations.of(animation.id)
    outdated = [cut for cut in cuts if not cut.live and cut.updated < oldest]
    for cut in outdated:
        forget_segmentation(jobs, blobs, cut.id)
    if not unused or any(cut.live for cut in cuts):
        return
    forget_files(jobs, blobs, animation)
    if not jobs.records.animations.delete(animation):
        jobs.records.animations.strip(animation)
