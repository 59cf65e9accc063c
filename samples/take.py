"""One long take: motions performed one after the other, and where each begins."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float

from caesura.samples.ground import feet_to_ground, root
from caesura.samples.motions import DRIVES, Course, Motion
from caesura.samples.skeleton import HUMAN, JOINTS, quaternions

RATE = 30.0
FADE = 8  # frames of a cross-fade on each side of a cut: half a second in all
SWAY = 1.1  # degrees: how far a body wanders from what it means to do
BREATH = 1.3  # degrees of the chest


@dataclass(frozen=True)
class Part:
    """A motion, and the frames at which its repetitions end; the last of them is whole."""

    motion: Motion
    ends: Float[np.ndarray, "repetitions"]

    @property
    def frames(self) -> int:
        """How long the part is."""
        return round(float(self.ends[-1]))


@dataclass(frozen=True)
class Truth:
    """What was performed: labels and frames [start, end) that tile the take, and how often."""

    fps: float
    frames: int
    segments: tuple[tuple[str, int, int], ...]
    repeats: tuple[tuple[int, ...], ...]  # of each segment: the frames at which its repetitions end

    def document(self) -> dict[str, object]:
        """As JSON values: the form of the truth files that `caesura score` reads."""
        segments = [
            {"label": label, "start": start, "end": end, "repeats": _intervals(start, ends)}
            for (label, start, end), ends in zip(self.segments, self.repeats, strict=True)
        ]
        return {"fps": self.fps, "frames": self.frames, "segments": segments}


def _intervals(start: int, ends: Sequence[int]) -> list[dict[str, int]]:
    return [{"start": a, "end": b} for a, b in pairwise((start, *ends))]


@dataclass(frozen=True)
class Sample:
    """A GLB, and what is performed in it."""

    glb: bytes
    truth: Truth


@dataclass(frozen=True)
class Take:
    """A performed take: the root's place, the rotation of every joint in its parent, and the truth."""

    rotations: Float[np.ndarray, "J frames 4"]
    places: Float[np.ndarray, "frames 3"]
    truth: Truth

    @property
    def seconds(self) -> Float[np.ndarray, "frames"]:
        """The time of every frame, float32 and never rounded down: a last key a hair early would lose its frame."""
        exact = np.arange(len(self.places)) / RATE
        near = exact.astype(np.float32)
        return np.where(near < exact, np.nextafter(near, np.float32(np.inf)), near)


def perform(parts: Sequence[Part], random: np.random.Generator) -> Take:
    """The take of these parts. Each begins where its first repetition does: in the middle of a cross-fade of half
    a second.
    """
    cuts = np.concatenate([[0], np.cumsum([part.frames for part in parts])]).tolist()
    length = cuts[-1]
    course = Course(np.zeros((length, JOINTS, 3)), np.zeros((length, len(DRIVES))))
    for part, start, end in zip(parts, cuts, cuts[1:], strict=False):
        first, last = max(start - FADE, 0), min(end + FADE, length)
        frames = np.arange(first, last)
        clip = part.motion.perform(frames - float(start), part.ends, random)
        share = _fade(frames, start, end, length)
        course.angles[first:last] += share[:, None, None] * clip.angles
        course.drives[first:last] += share[:, None] * clip.drives
    course.angles[:] += _wander(length, random)
    names = [part.motion.name for part in parts]
    segments = tuple(zip(names, cuts, cuts[1:], strict=False))
    repeats = tuple(tuple(np.rint(s + p.ends).astype(int).tolist()) for p, s in zip(parts, cuts, strict=False))
    return _record(course, Truth(RATE, length, segments, repeats))


def _record(course: Course, truth: Truth) -> Take:
    angles = feet_to_ground(course.angles)
    heading, places = root(course, angles, RATE)
    local = np.moveaxis(HUMAN.rotations(angles), 1, 0)
    cos, sin, none = np.cos(heading), np.sin(heading), np.zeros_like(heading)
    turned = np.stack([cos, none, sin, none, none + 1, none, -sin, none, cos], axis=-1).reshape(-1, 3, 3)
    rotations = [quaternions(turned @ r if joint == 0 else r) for joint, r in enumerate(local)]
    return Take(np.stack(rotations), places, truth)


def _fade(frames: np.ndarray, start: int, end: int, length: int) -> Float[np.ndarray, "frames"]:
    """The share of one part in each frame; the shares of neighbours sum to 1."""
    rise = _smooth((frames - start + FADE) / (2 * FADE)) if start > 0 else np.ones(len(frames))
    fall = _smooth((frames - end + FADE) / (2 * FADE)) if end < length else np.zeros(len(frames))
    return rise - fall


def _smooth(x: Float[np.ndarray, "n"]) -> Float[np.ndarray, "n"]:
    held: Float[np.ndarray, "n"] = np.clip(x, 0.0, 1.0)
    held *= held * (3 - 2 * held)
    return held


def _wander(frames: int, random: np.random.Generator) -> Float[np.ndarray, "frames J 3"]:
    """Breathing, and slow aimless drifts of every angle; the feet drift least."""
    seconds = np.arange(frames) / RATE
    drift = np.zeros((frames, JOINTS, 3))
    for slow in (0.07, 0.19, 0.43):  # cycles a second
        turns = (
            2 * np.pi * (slow * np.outer(seconds, random.uniform(0.8, 1.25, JOINTS * 3)) + random.random(JOINTS * 3))
        )
        drift += np.sin(turns).reshape(drift.shape) / 3**0.5
    drift *= (
        SWAY
        * np.array([0.25 if n.startswith(("foot", "toes", "shin", "thigh")) else 1.0 for n in HUMAN.names])[:, None]
    )
    drift[:, HUMAN.index("chest"), 0] += BREATH * np.sin(2 * np.pi * 0.24 * seconds)
    return drift
