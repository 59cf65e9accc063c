"""Deleting what was kept: blobs before the record that points to them, so that it can be repeated when cut short."""

from worker import keys
from worker.blobs import Blobs
from worker.jobs import Jobs
from worker.schema import AnimationRecord

EXPORTS = ("npz",)


def forget_segmentation(jobs: Jobs, blobs: Blobs, identifier: str) -> None:
    """Cancel a segmentation where it is live, and delete it with every file made of it; the analysis stays."""
    for form in EXPORTS:
        made = jobs.records.export(identifier, form)
        if made is not None and made.key is not None:
            blobs.delete(made.key)
        jobs.redis.delete(keys.export_key(identifier, form))
    jobs.delete(identifier)


def forget_animation(jobs: Jobs, blobs: Blobs, animation: AnimationRecord) -> None:
    """Delete an upload and everything derived from it."""
    for segmentation in jobs.records.segmentations(animation.id):
        forget_segmentation(jobs, blobs, segmentation.id)
    forget_files(jobs, blobs, animation)
    jobs.records.delete_animation(animation)


def forget_files(jobs: Jobs, blobs: Blobs, animation: AnimationRecord) -> None:
    """Delete an upload's files and what was computed from them; results stay."""
    for digest, analysis in jobs.records.analyses(animation.id).items():
        for key in analysis.blobs():
            blobs.delete(key)
        jobs.records.delete_analysis(animation.id, digest)
    for part in animation.parts:
        blobs.delete(part.key)
