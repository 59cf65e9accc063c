"""The key-frames as one file: an animation that steps from key pose to key pose."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from jaxtyping import Float

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.clip_names import name_clips_of_motions
from caesura.formats.clips.clip_plan import TakeFrames
from caesura.formats.clips.take_channels import ClipTracks, take_channels
from caesura.formats.clips.take_ranges import gltf_take_ranges
from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive

NAME = "key_frames"


def write_gltf_key_poses(file: AnimationReplacement, document: SegmentationDocument) -> Iterator[bytes]:
    """The uploaded glTF, its take replaced by the key poses, each at its own time in the take."""
    _require_key_frames(document)
    take_ranges = [s for s in gltf_take_ranges(file, document) if _frames(document, s)]
    file.remove({take_range.take for take_range in take_ranges})
    names = [NAME] if len(take_ranges) == 1 else name_clips_of_motions([(NAME, False)] * len(take_ranges), ())
    for name, take_range in zip(names, take_ranges, strict=True):
        frames = _frames(document, take_range)
        exact = take_range.start + (np.array(frames) - take_range.first) / document.frame_rate
        tracks = ClipTracks()
        for channel in take_channels(file, take_range.take):
            output = file.array(
                channel.keys.at(exact).astype(np.float32), channel.output.type, channel.output.width, {}
            )
            tracks.add(
                channel.target,
                {
                    "input": file.times(_round_down_to_float32(exact)),
                    "output": output,
                    "interpolation": "STEP",
                    **channel.sampler_extras,
                },
            )
        source = file.document.animations[take_range.take].value
        file.add(take_range.take, [tracks.animation(name, source, _extras(document, frames))])
    return file.pieces()


def write_npz_key_poses(animation: Animation, document: SegmentationDocument) -> Iterator[bytes]:
    """A vertex sequence's key poses as morph targets of the first one, each on until the next."""
    _require_key_frames(document)
    frames = [key.frame for key in document.key_frames]
    seconds = _round_down_to_float32(animation.start_seconds + np.array(frames) / document.frame_rate)
    poses = [animation.vertices(frame, frame + 1)[0] for frame in frames]
    out = GlbWriter()
    targets = [pose - poses[0] for pose in poses[1:]]
    mesh = out.mesh("mesh", [Primitive(poses[0], animation.triangles, targets=targets)], weights=[0.0] * len(targets))
    node = out.node("mesh", mesh=mesh)
    if targets:
        weights = np.eye(len(poses), dtype=np.float32)[:, 1:].reshape(-1)
        out.animation(NAME, [Channel(node, "weights", seconds, weights, "STEP")])
    yield out.to_bytes(_extras(document, frames))


def _require_key_frames(document: SegmentationDocument) -> None:
    if not document.key_frames:
        detail = "The result has no key-frames. Ask for a lower threshold or a shorter keyframe_window_seconds."
        raise InvalidModel("no-key-frames", detail)


def _frames(document: SegmentationDocument, take_range: TakeFrames) -> list[int]:
    return [key.frame for key in document.key_frames if take_range.first <= key.frame < take_range.end]


def _round_down_to_float32(seconds: Float[np.ndarray, "keys"]) -> Float[np.ndarray, "keys"]:
    """As float32, none later than meant: at its own frame a key pose is there already."""
    rounded = seconds.astype(np.float32)
    return np.where(rounded > seconds, np.nextafter(rounded, np.float32(0)), rounded)


def _extras(document: SegmentationDocument, frames: list[int]) -> dict[str, Any]:
    return ({"segmentation": document.id} if document.id else {}) | {"key_frames": frames}
