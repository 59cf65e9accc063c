"""What a take is compared by, as blobs: its poses are measured once, the rest follows from them and the pose space."""

import io
import struct
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from caesura.core.revision import apply_revision
from caesura.core.segmentation_document import SegmentationDocument
from caesura.core.together.example_search import IndexedTake, index_take
from caesura.core.together.measured_take import MeasuredTake, measure_take
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.take_segments import sign_take
from caesura.formats.read import read_animation
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import TakeRecord
from caesura.worker.records.record_types import SegmentationRecord
from caesura.worker.records.revisions import read_edits
from caesura.worker.store.blobs import BlobMissing, Blobs
from caesura.worker.store.memory_maps import map_parts, scratch_space

SEARCHED = struct.Struct("<qqdq")
"""Before what is searched of a take: its frames, stride and frame rate, and how many numbers a step has. A search reads
a thousand of them, and a hundred times as long would go into the headers of NPZ."""


def measure(here: WorkerContext, quota: JobQuota, segmentation: SegmentationRecord) -> tuple[MeasuredTake, float]:
    """A take as it is compared, from its file and its own result, and the time of its first frame.

    Where a person has revised the result, the newest revision is its own cut. Raises `BlobMissing` where the file or
    the result is gone, and what reading the file raises.
    """
    document = own_result(here, segmentation)
    animation = here.jobs.records.animations.one(segmentation.animation)
    if animation is None or not animation.parts:
        raise BlobMissing(segmentation.animation)
    with map_parts(here.blobs, animation.parts, quota.extend) as parts:
        scratch = scratch_space(here.settings.scratch_dir, quota.extend)
        read = read_animation(parts, segmentation.chosen(), here.settings.limits, scratch)
        return measure_take(animation.id, read, document.segments), document.source.start_seconds


def own_result(here: WorkerContext, segmentation: SegmentationRecord) -> SegmentationDocument:
    """The result of a take alone, with the newest revision of it; raises `BlobMissing`."""
    records = here.jobs.records
    stored, _, _ = records.segmentations.result(segmentation.id)
    if stored is None:
        raise BlobMissing(segmentation.id)
    document = SegmentationDocument.model_validate_json(stored)
    edits = read_edits(records, segmentation.id, segmentation.revision) if segmentation.revision else None
    return document if edits is None else apply_revision(document, segmentation.revision, edits)


def read_measured(blobs: Blobs, take: TakeRecord) -> MeasuredTake:
    """A take with its own cut; raises `BlobMissing` where its numbers are no longer kept."""
    if take.numbers is None:
        raise BlobMissing(take.animation)
    return MeasuredTake.from_bytes(blobs.read(take.numbers.poses))


def as_labelled(measured: MeasuredTake, take: TakeRecord) -> MeasuredTake:
    """The same with the cuts that it has in its collection."""
    bounds = [0, *(one.end for one in take.segments)]
    ones = np.ones(len(take.segments), np.int64)
    return replace(measured, bounds=np.array(bounds, np.int64), motions=0 * ones, repetitions=ones)


def put_indices(
    blobs: Blobs,
    takes: Sequence[TakeRecord],
    measured: Sequence[MeasuredTake],
    signatures: Sequence[MotionSignatures],
    space: tuple[str, PoseSpace],
) -> list[TakeRecord]:
    """The takes with the signatures of their segments and what is searched of them kept, in a space of this blob."""
    key, learned = space
    signed = blobs.put_all([_signatures_bytes(one) for one in signatures], "collections")
    searched = [_searched_bytes(index_take(learned, one.name, one.poses)) for one in measured]
    kept = []
    for take, *keys in zip(takes, signed, blobs.put_all(searched, "collections"), strict=True):
        assert take.numbers is not None  # noqa: S101  it is measured
        names = {"space": key, "signatures": keys[0], "searched": keys[1]}
        kept.append(take.model_copy(update={"numbers": take.numbers.model_copy(update=names)}))
    return kept


def read_signatures(blobs: Blobs, take: TakeRecord, stored: StoredSpace) -> MotionSignatures:
    """The signatures of a take's segments: as they are kept, or made where they are not."""
    if take.numbers is None or take.numbers.signatures is None:
        return sign_take(stored.space, as_labelled(read_measured(blobs, take), take))
    with np.load(io.BytesIO(blobs.read(take.numbers.signatures)), allow_pickle=False) as kept:
        return MotionSignatures(*(kept[name].astype(np.float32) for name in ("means", "poses", "speeds")))


def read_searched(blobs: Blobs, take: TakeRecord) -> IndexedTake:
    """What is searched of a take; raises `BlobMissing` where it is not kept."""
    if take.numbers is None or take.numbers.searched is None:
        raise BlobMissing(take.animation)
    stored = blobs.read(take.numbers.searched)
    frames, stride, frame_rate, size = SEARCHED.unpack_from(stored)
    values = np.frombuffer(stored, "<f2", offset=SEARCHED.size).reshape(-1, size).astype(np.float32)
    return IndexedTake(take.animation, values, frames, stride, frame_rate)


def _signatures_bytes(signatures: MotionSignatures) -> bytes:
    out = io.BytesIO()
    halves = {name: getattr(signatures, name).astype(np.float16) for name in ("means", "poses", "speeds")}
    np.savez(out, **halves)
    return out.getvalue()


def _searched_bytes(searched: IndexedTake) -> bytes:
    values = searched.values
    head = SEARCHED.pack(searched.frames, searched.stride, searched.frame_rate, values.shape[1])
    return head + values.astype("<f2").tobytes()
