"""A collection as bytes, and back: an NPZ of plain arrays and one JSON member, nothing pickled."""

import io
import json
from dataclasses import asdict

import numpy as np

from caesura.core.together.motion_collection import CollectedSegment, CollectedTake, MotionCollection
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space_file import space_from_arrays, space_to_arrays


def collection_to_bytes(collection: MotionCollection) -> bytes:
    """About 5 kB a segment, and the poses of no take."""
    meta = {
        "takes": [asdict(take) for take in collection.takes],
        "segments": [asdict(segment) for segment in collection.segments],
        "names": list(collection.names),
        "alike": collection.alike,
        "next_id": collection.next_id,
    }
    out = io.BytesIO()
    np.savez(
        out,
        meta=np.frombuffer(json.dumps(meta).encode(), np.uint8),
        **space_to_arrays(collection.space),
        spreads=collection.spreads,
        means=collection.signatures.means,
        poses=collection.signatures.poses,
        speeds=collection.signatures.speeds,
    )
    return out.getvalue()


def collection_from_bytes(data: bytes) -> MotionCollection:
    """The collection that `collection_to_bytes` wrote."""
    with np.load(io.BytesIO(data), allow_pickle=False) as stored:
        meta = json.loads(stored["meta"].tobytes())
        return MotionCollection(
            space=space_from_arrays(stored),
            takes=tuple(CollectedTake(**take) for take in meta["takes"]),
            segments=tuple(
                CollectedSegment(**{**segment, "refused": tuple(segment["refused"])}) for segment in meta["segments"]
            ),
            signatures=MotionSignatures(stored["means"], stored["poses"], stored["speeds"]),
            names=tuple((int(motion), str(name)) for motion, name in meta["names"]),
            spreads=stored["spreads"],
            alike=float(meta["alike"]),
            next_id=int(meta["next_id"]),
        )
