"""Small motions with known answers, as NumPy arrays."""

from dataclasses import dataclass

import numpy as np

from caesura.core.animation import Animation, Take

RATE = 30.0


def animation(vertices, triangles, *, rest=None, rate=RATE):
    """An animation of vertices (frames, V, 3) that are at hand."""
    held = np.ascontiguousarray(vertices, np.float32)
    frames = len(held)
    take = Take(0, "take", (frames - 1) / rate, frames, rate)
    faces = np.asarray(triangles, np.int64).reshape(-1, 3)
    shape = None if rest is None else np.asarray(rest, np.float32)
    return Animation(lambda start, stop: held[start:stop], held.shape[1], faces, shape, frames, rate, take)


def bar(rings=40, around=8):
    """A straight tube along x from 0 to 1, of radius 0.05, and its triangles."""
    angle = 2 * np.pi * np.arange(around) / around
    x = np.repeat(np.linspace(0, 1, rings), around)
    y, z = np.tile(0.05 * np.cos(angle), rings), np.tile(0.05 * np.sin(angle), rings)
    start = around * np.arange(rings - 1)[:, None]
    here, beside = start + np.arange(around), start + (np.arange(around) + 1) % around
    one = np.stack([here, beside, here + around], -1).reshape(-1, 3)
    other = np.stack([beside, beside + around, here + around], -1).reshape(-1, 3)
    return np.stack([x, y, z], 1).astype(np.float32), np.concatenate([one, other])


def turned(points, angle, axis=(1.0, 2.0, 3.0)):
    """Points turned about an axis through the origin (Rodrigues)."""
    k = np.asarray(axis) / np.linalg.norm(axis)
    cos, sin = np.cos(angle), np.sin(angle)
    return points * cos + np.cross(k, points) * sin + np.outer(points @ k, k) * (1 - cos)


def _bend(rest, swing):
    return np.stack([0 * swing, swing * np.maximum(rest[:, 0] - 0.5, 0) ** 2 * 2, 0 * swing], 1)


def _sway(rest, swing):
    return np.stack([0 * swing, 0 * swing, swing * np.maximum(0.5 - rest[:, 0], 0) ** 2 * 2], 1)


def _stretch(rest, swing):
    return np.stack([0.5 * swing * np.clip(rest[:, 0] - 0.3, 0, 0.4), 0 * swing, 0 * swing], 1)


def _swell(rest, swing):
    near = np.exp(-(((rest[:, 0] - 0.8) / 0.1) ** 2))
    return np.stack([0 * swing, 0.5 * swing * near * rest[:, 1], 0.5 * swing * near * rest[:, 2]], 1)


MOTIONS = (_bend, _sway, _stretch, _swell)


@dataclass(frozen=True)
class Performance:
    """An animation, and the motion of every frame."""

    animation: Animation
    truth: np.ndarray


def performing_bar(order, *, seconds=6.0, fade=0.4, rate=RATE, rings=40):
    """The bar doing `MOTIONS` in this order, about one swing a second, cross-faded over `fade` seconds."""
    rest, triangles = bar(rings)
    frames = round(len(order) * seconds * rate)
    time = np.arange(frames) / rate
    vertices = np.repeat(rest[None].astype(np.float64), frames, axis=0)
    for place, motion in enumerate(order):
        begins, ends = place * seconds, (place + 1) * seconds
        weight = np.clip(0.5 + (time - begins) / fade, 0, 1) * np.clip(0.5 + (ends - time) / fade, 0, 1)
        for frame in np.flatnonzero(weight):
            swing = np.full(len(rest), 0.6 + 0.4 * np.sin(2 * np.pi * time[frame] * (1 + 0.1 * motion)))
            vertices[frame] += weight[frame] * MOTIONS[motion](rest, swing)
    truth = np.asarray(order)[np.minimum((time / seconds).astype(int), len(order) - 1)]
    return Performance(animation(vertices, triangles, rest=rest, rate=rate), truth)


def tumbling(rest, frames, *, far=0.0, seed=0):
    """The same rigid shape at large angles and, with `far`, away from the origin: (frames, V, 3)."""
    draw = np.random.default_rng(seed)
    return np.stack(
        [turned(rest.astype(np.float64), a, draw.normal(size=3)) + far * draw.normal(size=3) for a in np.arange(frames)]
    )
