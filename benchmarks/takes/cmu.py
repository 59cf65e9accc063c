"""CMU motion capture as the paper uses it: skinned to a body, every fourth frame of 120, with the annotated cuts."""

from dataclasses import dataclass
from math import ceil
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from benchmarks.takes.acclaim import Acclaim, read_motion, read_skeleton
from benchmarks.takes.body import SHARPNESS, Body, body
from caesura.core.animation import Animation, Take

STEP = 4
RATE = 30.0


@dataclass(frozen=True)
class Annotation:
    """Segments of one trial: labels, and the frames (of 30 a second) at which they end, with the accepted range."""

    labels: tuple[str, ...]
    ends: tuple[int, ...]
    ranges: tuple[tuple[int, int], ...]

    @property
    def order(self) -> tuple[int, ...]:
        """The motion of every segment, numbered by first appearance of its label."""
        numbers = list(dict.fromkeys(self.labels))
        return tuple(numbers.index(label) for label in self.labels)

    @property
    def frames(self) -> Int[np.ndarray, "frames"]:
        """The motion of every frame."""
        return np.repeat(self.order, np.diff([0, *self.ends]))

    @property
    def motions(self) -> int:
        """How many distinct motions there are."""
        return len(set(self.labels))


@dataclass(frozen=True)
class _Skinned:
    """Draws blocks of frames of a body in motion."""

    shape: Body
    rotations: Float[np.ndarray, "frames bones 3 3"]
    starts: Float[np.ndarray, "frames bones 3"]

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        return self.shape.posed(self.rotations[start:stop], self.starts[start:stop])


def skinned(folder: Path, trial: str, sharpness: float = SHARPNESS) -> Animation:
    """One trial, such as `86_09`, as a deforming mesh at 30 frames a second; its rest shape is the skeleton's."""
    subject, _, _ = trial.partition("_")
    skeleton = read_skeleton((folder / f"{subject}.asf").read_text())
    return animation(skeleton, body(skeleton, sharpness), (folder / f"{trial}.amc").read_text(), trial)


def animation(skeleton: Acclaim, shape: Body, motion: str, name: str) -> Animation:
    """The body performing the motion of an .amc file."""
    courses = {bone: course[::STEP] for bone, course in read_motion(motion).items()}
    frames = len(courses["root"])
    rotations, starts = skeleton.pose(courses, frames)
    return Animation(
        vertices=_Skinned(shape, rotations, starts),
        vertex_count=len(shape.surface.vertices),
        triangles=shape.triangles.astype(np.int64),
        rest=shape.surface.vertices.astype(np.float32),
        frames=frames,
        frame_rate=RATE,
        take=Take(0, name, (frames - 1) / RATE, frames, RATE),
    )


def annotation(text: str, trial: str) -> Annotation:
    """One trial's cuts from `mocap.txt`: blocks headed by the trial, lines of label, earliest, cut and latest frame.

    The cut is the last frame of its segment, counted from 1, at 120 a second; here it becomes the first frame
    after it, at 30.
    """
    blocks = [block.split("\n") for block in text.replace("\r", "").replace(" \n", "\n").split("\n\n")]
    rows = next(block[1:] for block in blocks if block[0].split() == trial.split("_"))
    fields = [row.split() for row in rows if row.strip()]
    first, cut, latest = ([ceil(int(f[column]) / STEP) for f in fields] for column in (1, 2, 3))
    return Annotation(tuple(f[0] for f in fields), tuple(cut), tuple(zip(first, latest, strict=True)))
