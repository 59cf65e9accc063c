"""The key-frames as one file: an animation that steps from key pose to key pose."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from jaxtyping import Float

from core.animation import Animation
from core.document import SegmentationDocument
from core.errors import InvalidModel
from core.formats.clips.channels import Tracks, take_channels
from core.formats.clips.replacement import Replacement
from core.formats.gltf.writer import Channel, GlbWriter, Primitive

NAME = "key_frames"


def gltf_key_poses(file: Replacement, document: SegmentationDocument) -> Iterator[bytes]:
    """The uploaded glTF, its take replaced by the key poses, each at its own time in the take."""
    seconds = _seconds(document)
    take = document.source.take
    file.remove([take], take)
    tracks = Tracks()
    for channel in take_channels(file, take):
        values = channel.keys.at(_exact(document)).astype(np.float32)
        output = file.array(values, channel.output.type, channel.output.width, {})
        sampler = {"input": file.times(seconds), "output": output, "interpolation": "STEP"}
        tracks.add(channel.target, sampler | channel.more)
    file.add([tracks.animation(NAME, file.document.animations[take].value, _extras(document))])
    return file.pieces()


def sequence_key_poses(animation: Animation, document: SegmentationDocument) -> Iterator[bytes]:
    """A vertex sequence's key poses as morph targets of the first one, each on until the next."""
    seconds = _seconds(document)
    poses = [animation.vertices(key.frame, key.frame + 1)[0] for key in document.key_frames]
    out = GlbWriter()
    targets = [pose - poses[0] for pose in poses[1:]]
    mesh = out.mesh("mesh", [Primitive(poses[0], animation.triangles, targets=targets)], weights=[0.0] * len(targets))
    node = out.node("mesh", mesh=mesh)
    if targets:
        weights = np.eye(len(poses), dtype=np.float32)[:, 1:].reshape(-1)
        out.animation(NAME, [Channel(node, "weights", seconds, weights, "STEP")])
    yield out.to_bytes(_extras(document))


def _seconds(document: SegmentationDocument) -> Float[np.ndarray, "keys"]:
    """The times of the key-frames in the take, float32 and none too late for its frame; raises where there are none."""
    if not document.key_frames:
        raise InvalidModel(
            "no-key-frames", "The result has no key-frames. Ask for a lower threshold or a shorter window."
        )
    exact = _exact(document)
    seconds = exact.astype(np.float32)
    return np.where(seconds > exact, np.nextafter(seconds, np.float32(0)), seconds)


def _exact(document: SegmentationDocument) -> Float[np.ndarray, "keys"]:
    return np.array([key.frame / document.frame_rate for key in document.key_frames])


def _extras(document: SegmentationDocument) -> dict[str, Any]:
    frames = {"key_frames": [key.frame for key in document.key_frames]}
    return ({"segmentation": document.id} if document.id else {}) | frames
