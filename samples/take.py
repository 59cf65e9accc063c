"""One long take: motions performed one after the other, and where each begins."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from samples.ground import feet_to_ground, root
from samples.motions import Course, Motion
from samples.skeleton import HUMAN, JOINTS, quaternions

RATE = 30.0
FADE = 8  # frames of a cross-fade on each side of a cut: half a second in all
SWAY = 1.1  # degrees: how far a body wanders from what it means to do
BREATH = 1.3  # degrees of the chest


@dataclass(frozen=True)
class Part:
    """A motion and how often it is repeated; the last repetition may be cut short by `frames`."""

    motion: Motion
    repetitions: int
    label: str = ""


@dataclass(frozen=True)
class Truth:
    """What was performed: labels and frames [start, end) that tile the take."""

    fps: float
    frames: int
    segments: tuple[tuple[str, int, int], ...]

    def document(self) -> dict[str, object]:
        """As JSON values: the form of the truth files that `caesura score` reads."""
        segments = [{"label": label, "start": start, "end": end} for label, start, end in self.segments]
        return {"fps": self.fps, "frames": self.frames, "segments": segments}


@dataclass(frozen=True)
class Take:
    """A performed take: the root's place, the rotation of every joint in its parent, and the truth."""

    rotations: Float[np.ndarray, "J frames 4"]
    places: Float[np.ndarray, "frames 3"]
    truth: Truth

    @property
    def seconds(self) -> Float[np.ndarray, "frames"]:
        """The time of every frame."""
        return np.arange(len(self.places)) / RATE


def perform(parts: Sequence[Part], seed: int, frames: int | None = None) -> Take:
    """The take of these parts. Each begins where its first repetition does, in the middle of a cross-fade of
    half a second; the take ends with its last part, or at `frames` where that is sooner.
    """
    random = np.random.default_rng(seed)
    ends = [part.motion.ends(part.repetitions, RATE, random) for part in parts]
    cuts = np.concatenate([[0], np.cumsum([round(e[-1]) for e in ends])])
    course = _empty(int(cuts[-1]))
    for part, part_ends, start, end in zip(parts, ends, cuts, cuts[1:], strict=False):
        first, last = max(start - FADE, 0), min(end + FADE, cuts[-1])
        clip = part.motion.perform(np.arange(first, last) - float(start), part_ends, random)
        share = _fade(np.arange(first, last), start, end, cuts[-1])
        course.angles[first:last] += share[:, None, None] * clip.angles
        course.drives[first:last] += share[:, None] * clip.drives
    cuts = np.minimum(cuts, frames or cuts[-1])
    course = Course(course.angles[: cuts[-1]], course.drives[: cuts[-1]])
    course.angles[:] += _wander(len(course.angles), random)
    labels = [part.label or part.motion.name for part in parts]
    spans = zip(labels, cuts.tolist(), cuts[1:].tolist(), strict=False)
    return _record(course, Truth(RATE, int(cuts[-1]), tuple(span for span in spans if span[1] < span[2])))


def _record(course: Course, truth: Truth) -> Take:
    angles = feet_to_ground(course.angles)
    heading, places = root(course, angles, RATE)
    local = np.moveaxis(HUMAN.rotations(angles), 1, 0)
    cos, sin, none = np.cos(heading), np.sin(heading), np.zeros_like(heading)
    turned = np.stack([cos, none, sin, none, none + 1, none, -sin, none, cos], axis=-1).reshape(-1, 3, 3)
    rotations = [quaternions(turned @ r if joint == 0 else r) for joint, r in enumerate(local)]
    return Take(np.stack(rotations), places, truth)


def _empty(frames: int) -> Course:
    return Course(np.zeros((frames, JOINTS, 3)), np.zeros((frames, 4)))


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
