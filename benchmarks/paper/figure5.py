"""The paper's figure 5: does its method find walk, look around, clap, stand and clap, walk in CMU 86_09?

    python -m benchmarks.paper.figure5 --cmu ../shared/data/cmu86

Runs `joint-entropy`, told the number of motions, over a fixed grid of 20 settings in the ranges the paper gives
(window l of 1.3 to 1.7 s, key-frame window ω of 2.0 to 2.3 s). The stated setting is the method's defaults, l = 1.3 s
and ω = 2.0 s. A setting reproduces the figure where it gives five segments, the first and the last of one motion, the
others of motions of their own, and most frames of each segment are of the motion that the figure shows there.

The rest shape is frame 0, for the paper's animations are sequences of meshes, which have no bind pose; the last line
of the report says what the bind pose would give.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from benchmarks.reports.drawing import drawn
from benchmarks.takes.cmu import Annotation, annotation, skinned
from caesura.core.agreement import frame_accuracy
from caesura.core.animation import Animation
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, segment
from caesura.core.segmentation import Segmentation

TRIAL = "86_09"
WINDOWS = (1.3, 1.4, 1.5, 1.6, 1.7)
KEYFRAME_WINDOWS = (2.0, 2.1, 2.2, 2.3)
STATED = (1.3, 2.0)
SHARPNESSES = (0.15, 0.3, 0.4, 0.5, 1.0, 2.0, 6.0)


@dataclass(frozen=True)
class Run:
    """What one setting gives: `order` is the motions of its segments, `shown` those the truth has there."""

    setting: tuple[float, float]
    found: Segmentation
    order: tuple[int, ...]
    shown: tuple[int, ...]
    accuracy: float

    @classmethod
    def of(cls, setting: tuple[float, float], found: Segmentation, truth: Annotation) -> "Run":
        """A segmentation, judged."""
        spans = [truth.frames[segment.start : segment.end] for segment in found.segments]
        shown = tuple(int(np.bincount(span).argmax()) for span in spans)
        order = tuple(segment.motion for segment in found.segments)
        return cls(setting, found, order, shown, frame_accuracy(found.labels, truth.frames))

    def reproduces(self, truth: Annotation) -> bool:
        """Whether this is the order of the figure, and in the figure's places."""
        return self.order == self.shown == truth.order

    def row(self, truth: Annotation) -> str:
        """One line of the table."""
        answer = "yes" if self.reproduces(truth) else "no"
        window, key = self.setting
        return f"{window:5.1f}  {key:5.1f}  {answer:8}  {self.accuracy:8.3f}  {self.found.cuts.tolist()}"


def stated(take: Animation, truth: Annotation) -> Segmentation:
    """The segmentation at the stated setting."""
    window, key = STATED
    parameters = Parameters(
        method="joint-entropy", motions=truth.motions, window_seconds=window, keyframe_window_seconds=key, rest=0
    )
    return segment(take, parameters, threads=2)


def runs(take: Animation, truth: Annotation, rest: Literal["bind"] | int) -> list[Run]:
    """The grid of settings; the vertices are looked at once for each window."""
    made = []
    for window in WINDOWS:
        asked = Parameters(method="joint-entropy", motions=truth.motions, window_seconds=window, rest=rest)
        analysis = analyse(take, asked, threads=2)
        for key in KEYFRAME_WINDOWS:
            found = cut(analysis, asked.model_copy(update={"keyframe_window_seconds": key}))
            made.append(Run.of((window, key), found, truth))
    return made


def report(take: Animation, truth: Annotation) -> list[str]:
    """The table, the stated setting, and how many settings reproduce the figure."""
    grid, bound = runs(take, truth, rest=0), runs(take, truth, rest="bind")
    chosen = next(run for run in grid if run.setting == STATED)
    answer = "reproduces" if chosen.reproduces(truth) else "does not reproduce"
    return [
        f"{TRIAL}: {take.frames} frames, {len(take.triangles)} triangles; {', '.join(truth.labels)}",
        f"l (s)  ω (s)  figure 5  accuracy  cuts; the truth is {list(truth.ends[:-1])}",
        *[run.row(truth) for run in grid],
        f"The stated setting, l = {STATED[0]} s and ω = {STATED[1]} s, {answer} it; accuracy {chosen.accuracy:.3f}.",
        f"{_count(grid, truth)} settings reproduce it; mean accuracy {_mean(grid):.3f}.",
        f"{len({run.found.labels.tobytes() for run in grid})} of {len(grid)} settings differ in what they find.",
        f"With the bind pose as rest shape: {_count(bound, truth)}; mean accuracy {_mean(bound):.3f}.",
    ]


def other_bodies(folder: Path, truth: Annotation) -> list[str]:
    """How much hangs on the body: the same grid with sharper and softer weights."""
    lines = ["sharpness of the weights  settings that reproduce it  mean accuracy"]
    for sharpness in SHARPNESSES:
        grid = runs(skinned(folder, TRIAL, sharpness), truth, rest=0)
        lines.append(f"{sharpness:24}  {_count(grid, truth):>27}  {_mean(grid):13.3f}")
    return lines


def _count(grid: Sequence[Run], truth: Annotation) -> str:
    return f"{sum(run.reproduces(truth) for run in grid)} of {len(grid)}"


def _mean(grid: Sequence[Run]) -> float:
    return float(np.mean([run.accuracy for run in grid]))


def main() -> None:
    """Reads the captures and prints the report."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    options.add_argument("--cmu", type=Path, required=True, help="folder with 86.asf, 86_09.amc and mocap.txt")
    options.add_argument("--bodies", action="store_true", help="also try bodies with sharper and softer weights")
    options.add_argument("--svg", type=Path, help="draw the stated setting, as the paper's figure does")
    asked = options.parse_args()
    take, truth = skinned(asked.cmu, TRIAL), annotation((asked.cmu / "mocap.txt").read_text(), TRIAL)
    print(*report(take, truth), sep="\n")
    if asked.bodies:
        print(*other_bodies(asked.cmu, truth), sep="\n")
    if asked.svg:
        asked.svg.write_text(drawn(stated(take, truth), truth), encoding="utf-8")


if __name__ == "__main__":
    main()
