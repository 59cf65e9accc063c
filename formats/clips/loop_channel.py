"""A channel of a clip that loops: bent to its beginning at its end, and without its travel."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.channel_cut import ChannelPart
from caesura.formats.clips.channel_keys import ChannelKeys, quaternion_arc
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.take_channels import take_channels

KEY_SECONDS = 1 / 60
"""Between new keys, where a channel is bent or was a spline."""
TRAVEL = 3.0
"""A root that is so many of its largest steps farther at the end travels or turns: that stays, unless taken out."""


@dataclass(frozen=True)
class LoopClosing:
    """What becomes of the channels of a clip that loops. `roots` are the nodes that carry the body."""

    blend_seconds: float
    in_place: bool
    roots: frozenset[int]

    @classmethod
    def of(cls, file: AnimationReplacement, take: int, options: ClipOptions) -> "LoopClosing | None":
        """None where clips that loop stay as they were performed."""
        in_place = options.root == "in_place"
        if not in_place and not options.loop_blend_seconds:
            return None
        return cls(options.loop_blend_seconds, in_place, frozenset(root_nodes(file, take)))


def root_nodes(file: AnimationReplacement, take: int) -> Iterator[int]:
    """The nodes that move from place to place and are below none that does."""
    moving = {
        int(channel.target["node"])
        for channel in take_channels(file, take, nodes_only=True)
        if "node" in channel.target and channel.target["path"] == "translation"
        if (channel.keys.values != channel.keys.values[:1]).any()
    }
    nodes = file.document.nodes
    parents = {child: number for number, node in enumerate(nodes) for child in node.value.get("children", [])}
    for node in moving:
        above = parents.get(node)
        while above is not None and above not in moving:
            above = parents.get(above)
        if above is None:
            yield node


def loop_channel(
    keys: ChannelKeys, target: dict[str, object], span: tuple[float, float], origin: float, closing: LoopClosing
) -> ChannelPart | None:
    """The keys of `span`, in seconds of the take, closed; None for a channel of steps, which nothing is between."""
    if keys.interpolation == "STEP":
        return None
    start, end = span
    times = _key_times(keys, start, end, closing.blend_seconds)
    values = keys.at(times)
    root = target.get("node") in closing.roots
    if root and closing.in_place and target["path"] == "translation":
        values = values - (times - start)[:, None] / (end - start) * (values[-1] - values[0])
    if not (root and _travels(values, is_rotation=keys.is_rotation)) and closing.blend_seconds:
        share = _smooth_step((times - (end - closing.blend_seconds)) / closing.blend_seconds)
        values = _bent_to_start(values, share, is_rotation=keys.is_rotation)
    seconds = (times - origin).astype(np.float32)
    kept = np.concatenate([[True], np.diff(seconds) > 0])
    stored = values[kept, None].astype(np.float32)
    still = (stored == stored[:1]).all()
    return ChannelPart(seconds[kept][:1] if still else seconds[kept], stored[:1] if still else stored, linear=True)


def _key_times(keys: ChannelKeys, start: float, end: float, blend: float) -> Float[np.ndarray, "keys"]:
    """Those of the channel, and new ones where it is bent or curved."""
    inner = keys.times[(keys.times > start) & (keys.times < end)]
    first = start if keys.is_spline else max(end - blend, start)
    count = max(round((end - first) / KEY_SECONDS), 1)
    return np.unique(np.concatenate([[start], inner, np.linspace(first, end, count + 1)]))


def _travels(values: Float[np.ndarray, "keys width"], *, is_rotation: bool) -> bool:
    steps = np.abs(np.sum(values[1:] * values[:-1], axis=1)) if is_rotation else None
    if steps is not None:
        turned = np.arccos(min(abs(float(values[0] @ values[-1])), 1.0))
        return bool(turned > TRAVEL * np.arccos(np.minimum(steps, 1.0)).max(initial=0.0))
    largest = np.linalg.norm(np.diff(values, axis=0), axis=1).max(initial=0.0)
    return bool(np.linalg.norm(values[-1] - values[0]) > TRAVEL * largest)


def _bent_to_start(
    values: Float[np.ndarray, "keys width"], share: Float[np.ndarray, "keys"], *, is_rotation: bool
) -> Float[np.ndarray, "keys width"]:
    """The same plus a growing share of what the end misses the beginning by."""
    if not is_rotation:
        return np.asarray(values + share[:, None] * (values[0] - values[-1]))
    missed = _quaternion_product(values[:1], values[-1:] * np.array([-1.0, -1.0, -1.0, 1.0]))
    still = np.broadcast_to([0.0, 0.0, 0.0, 1.0], values.shape)
    part = quaternion_arc(still, np.broadcast_to(missed, values.shape), share[:, None])
    bent = _quaternion_product(part, values)
    return np.asarray(np.where(share[:, None] > 0, bent, values))


def _quaternion_product(p: Float[np.ndarray, "some 4"], q: Float[np.ndarray, "some 4"]) -> Float[np.ndarray, "some 4"]:
    """The turn q and then the turn p; (x, y, z, w)."""
    cross = np.cross(p[:, :3], q[:, :3])
    vector = p[:, 3:] * q[:, :3] + q[:, 3:] * p[:, :3] + cross
    scalar = p[:, 3:] * q[:, 3:] - np.sum(p[:, :3] * q[:, :3], axis=1, keepdims=True)
    return np.concatenate([vector, scalar], axis=1)


def _smooth_step(share: Float[np.ndarray, "some"]) -> Float[np.ndarray, "some"]:
    held = np.clip(share, 0.0, 1.0)
    return np.asarray(held * held * (3 - 2 * held))
