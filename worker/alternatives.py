"""Stored answers: the same take cut into every number of motions that was scored when nobody said how many.

They lie beside the result that scored them and go with it. Nobody has asked for them yet, so they are no
segmentations: the first time that one is asked for it becomes one, done at once and without a job.

What is stored is the segmentation document but for its energy curve, which is the result's, compressed. Light: the
web process answers with them, and has no arrays.
"""

import time
import zlib
from array import array
from sys import byteorder

from redis import WatchError
from redis.client import Pipeline

from caesura.core.document import Segment, SegmentationDocument
from caesura.worker.records import Records, redis_keys
from caesura.worker.records.schema import SegmentationRecord


def store_alternative(records: Records, identifier: str, document: SegmentationDocument) -> bool:
    """Keep one beside a result; False, and nothing kept, where the result is not there any more."""
    shown = document.model_copy(update={"id": None, "energy": ()}).model_dump_json()
    asked = str(document.parameters["motions"])
    with records.redis.pipeline() as pipe:
        while True:
            pipe.watch(redis_keys.segmentation_key(identifier))
            if not pipe.exists(redis_keys.segmentation_key(identifier)):
                return False
            pipe.multi()
            pipe.hset(redis_keys.alternatives_key(identifier), asked, zlib.compress(shown.encode()))
            try:
                pipe.execute()
            except WatchError:
                continue
            return True


def restore_alternative(records: Records, wanted: SegmentationRecord, beside: str) -> SegmentationRecord | None:
    """Make the segmentation `wanted`, done, of what is stored beside the result `beside`; None where nothing is.

    None too where it was asked for before: then it is as it is.
    """
    stored = records.redis.hget(redis_keys.alternatives_key(beside), str(wanted.parameters["motions"]))
    result = records.segmentations.one(beside)
    whole, energy, _ = records.segmentations.result(beside) if isinstance(stored, bytes) else (None, None, None)
    if not isinstance(stored, bytes) or result is None or whole is None or energy is None:
        return None
    alternative = SegmentationDocument.model_validate_json(zlib.decompress(stored))
    curve = SegmentationDocument.model_validate_json(whole).energy
    document = alternative.model_copy(update={"id": wanted.id, "energy": curve}).model_dump_json()

    def change(kept: SegmentationRecord) -> SegmentationRecord | None:
        if kept is not wanted and (kept.live or kept.settled):
            return None
        return kept.with_(
            status="done",
            stage="",
            fraction=1.0,
            problem=None,
            analysis=result.analysis,
            motions=alternative.motions,
            frames=alternative.frames,
            segments=alternative.segments,
        )

    def also(pipe: Pipeline, _: SegmentationRecord) -> None:
        pipe.set(redis_keys.segmentation_key(wanted.id, "document"), document)
        pipe.set(redis_keys.segmentation_key(wanted.id, "energy"), energy)
        pipe.set(redis_keys.segmentation_key(wanted.id, "labels"), encode_labels(alternative.segments))
        pipe.zadd(redis_keys.LAST_USED_KEY, {wanted.animation: time.time()}, xx=True)

    return records.segmentations.change(wanted.id, change, also, new=wanted)


def encode_labels(segments: tuple[Segment, ...]) -> bytes:
    """The motion of every frame: little-endian uint16."""
    labels = array("H")
    for segment in segments:
        labels.extend(array("H", [segment.motion]) * (segment.end - segment.start))
    if byteorder == "big":
        labels.byteswap()
    return labels.tobytes()
