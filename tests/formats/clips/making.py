"""Clips of files that tests have made, and what is in them."""

import json
import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from caesura.core.animation import Animation
from caesura.core.document import KeyFrame, Segment, SegmentationDocument, Source, motion_name
from caesura.core.parameters import Parameters
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.write import write_clips, write_key_poses
from tests.formats.opening import opened

IDENTIFIER = "x3t6kq2v5hn7ma4zr2wye6jd4p"


def scratch(size: int) -> memoryview:
    return memoryview(bytearray(size))


def cut_at(animation: Animation, cuts: Sequence[int], names: Sequence[str] = ()) -> SegmentationDocument:
    """The document of a take cut before these frames, its motions A, B, A, B, … or as named."""
    bounds = [0, *cuts, animation.frames]
    rate, take = animation.frame_rate, animation.take
    called = [*names] or [motion_name(i % 2) for i in range(len(cuts) + 1)]
    order = list(dict.fromkeys(called))
    return SegmentationDocument(
        id=IDENTIFIER, algorithm="1", method="switching", motions=len(order), frames=animation.frames, frame_rate=rate,
        parameters=Parameters(take=take.index, fps=rate).model_dump(), duration_seconds=(animation.frames - 1) / rate,
        source=Source(take=take.index, name=take.name, fps=rate), energy=(None,) * animation.frames,
        segments=tuple(
            Segment(start=a, end=b, start_seconds=a / rate, end_seconds=b / rate, motion=order.index(name), name=name)
            for a, b, name in zip(bounds[:-1], bounds[1:], called, strict=True)
        ),
        key_frames=tuple(KeyFrame(frame=f, seconds=f / rate, energy=1, motion=0) for f in (1, animation.frames // 2)),
    )  # fmt: skip


def clips_of(data: bytes | Mapping[str, bytes], document: SegmentationDocument, **options: Any) -> bytes:
    parts = {"model": data} if isinstance(data, bytes) else data
    return b"".join(write_clips(parts, document, ClipOptions.of(options), scratch).pieces)


def key_poses_of(data: bytes | Mapping[str, bytes], document: SegmentationDocument) -> bytes:
    parts = {"model": data} if isinstance(data, bytes) else data
    return b"".join(write_key_poses(parts, document, scratch).pieces)


def chunks_of(glb: bytes) -> tuple[dict[str, Any], bytes]:
    """JSON and binary chunk of a GLB that states its own lengths rightly."""
    magic, version, length = struct.unpack_from("<4sII", glb)
    assert (magic, version, length) == (b"glTF", 2, len(glb))
    size, kind = struct.unpack_from("<I4s", glb, 12)
    assert kind == b"JSON"
    root = json.loads(glb[20 : 20 + size])
    rest = glb[20 + size :]
    assert not rest or struct.unpack_from("<I4s", rest) == (len(rest) - 8, b"BIN\0")
    return root, rest[8:]


def names_of(glb: bytes) -> list[str]:
    return [animation.get("name", "") for animation in chunks_of(glb)[0]["animations"]]


def worst_miss(source: Animation, glb: bytes, document: SegmentationDocument) -> float:
    """How far a vertex of a clip is from where the source has it at that time, as a share of the diagonal.

    `source` is the take drawn a whole number of times as often as the document counts frames; so are the clips.
    """
    everything = source.vertices(0, source.frames)
    diagonal = np.linalg.norm(np.ptp(everything, axis=(0, 1)))
    finer = round(source.frame_rate / document.frame_rate)
    clips = [a["name"] for a in chunks_of(glb)[0]["animations"] if "caesura" in a.get("extras", {})]
    worst = 0.0
    for name, segment in zip(clips, document.segments, strict=True):
        clip = opened(glb, take=name, fps=source.frame_rate)
        expected = everything[segment.start * finer :][: clip.frames]
        actual = clip.vertices(0, len(expected))
        worst = max(worst, float(np.abs(actual - expected).max() / diagonal))
    return worst
