"""Sequences whose motions are known: what the methods are measured on."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Int

from benchmarks.takes import choreography as choreographies
from benchmarks.takes import joining
from benchmarks.takes.choreography import choreography
from benchmarks.takes.cmu import annotation, skinned
from benchmarks.takes.creatures import creature
from benchmarks.takes.joining import Joined, joined
from benchmarks.takes.labelled import Stretch, labelled, per_frame, read_labels
from caesura.core.analysis import Analysis
from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.formats.read import read_animation
from caesura.samples.performed_take import Sample
from caesura.samples.sample_figures import FIGURES, build_figure

DEVELOPMENT = frozenset({"fox_hard_0", "godotman_hard_0", "figure smooth", "figure rigid", "86_09"})
"""Takes on which the default method's constants were fixed, besides those of seeds below `HELD_BACK`."""
HELD_BACK = 301
"""The first seed at which nobody looked while constants were fixed: below it choreographies, creatures and joined
takes are for development, from it on they are kept back."""


@dataclass(frozen=True)
class Known:
    """One take, analysed, with its true motion per frame, and for captured ones the accepted range of each cut.

    `repeats` is how often each true segment performs its motion, where that is known.
    """

    name: str
    group: str
    analysis: Analysis
    truth: Int[np.ndarray, "frames"]
    ranges: tuple[tuple[int, int], ...] = ()
    repeats: tuple[int, ...] = ()
    animation: Animation | None = None

    def from_first_frame(self) -> Analysis | None:
        """The same with the first frame as rest pose; None where the vertices are not at hand."""
        return None if self.animation is None else analyse(self.animation, Parameters(rest=0))

    @property
    def motions(self) -> int:
        """How many motions there truly are."""
        return len(np.unique(self.truth))

    @classmethod
    def of_sample(cls, name: str, group: str, sample: Sample, threads: int = 1) -> "Known":
        """A take of the sample figures."""
        animation = _read("sample.glb", sample.glb)
        analysis = analyse(animation, threads=threads)
        repeats = tuple(len(ends) for ends in sample.truth.repeats)
        truth = truth_of(sample.truth.document(), analysis)
        return cls(name, group, analysis, truth, repeats=repeats, animation=animation)

    @classmethod
    def of_joined(cls, name: str, group: str, made: Joined, threads: int = 1) -> "Known":
        """A take joined from clips."""
        analysis = analyse(made.animation, threads=threads)
        return cls(name, group, analysis, made.truth, repeats=made.repeats, animation=made.animation)


def sequences(folder: Path | None, cmu: Path | None, *, figures: bool, held_back: int, threads: int) -> Iterator[Known]:
    """Captured trials, then the labelled files of a folder, then the sample characters and takes kept back."""
    yield from captured(cmu, threads) if cmu else ()
    for model, labels in labelled(folder).items() if folder else ():
        animation = _read(model.name, model.read_bytes())
        analysis = analyse(animation, threads=threads)
        truth = per_frame(read_labels(labels), analysis.frames, analysis.frame_rate)
        name = model.stem
        yield Known(name, "development" if name in DEVELOPMENT else "shared", analysis, truth, animation=animation)
    for name in FIGURES if figures else ():
        yield Known.of_sample(f"figure {name}", "development", build_figure(name), threads)
    yield from islice(kept_back(HELD_BACK, threads), held_back)


def captured(folder: Path, threads: int) -> Iterator[Known]:
    """Every trial of a CMU subject in a folder of SUBJECT.asf, TRIAL.amc and mocap.txt."""
    for motion in sorted(folder.glob("*.amc")):
        annotated = annotation((folder / "mocap.txt").read_text(), motion.stem)
        animation = skinned(folder, motion.stem)
        analysis = analyse(animation, threads=threads)
        frames = np.concatenate([annotated.frames, annotated.frames[-1:].repeat(analysis.frames)])[: analysis.frames]
        yield Known(motion.stem, "captured", analysis, frames, annotated.ranges[:-1], animation=animation)


def kept_back(
    first: int, threads: int = 1, motions: int | None = None, seconds: tuple[float, float] | None = None
) -> Iterator[Known]:
    """Takes made up by seeds from `first` on, without end: a creature, then one of the figures, in turns.

    Of each the odd seeds are skinned and the even ones of rigid parts. Where nobody says, four to seven motions, in
    segments that last as long as each kind's do.
    """
    seed = first
    while True:
        count = motions or 4 + seed % 4
        made = joined("creature.glb", creature(seed, count), count, seed, seconds or joining.SECONDS)
        yield Known.of_joined(f"creature {seed}", "kept back", made, threads)
        yield Known.of_sample(
            f"figures {seed}", "kept back", choreography(seed, motions, seconds or choreographies.SECONDS), threads
        )
        seed += 1


def truth_of(document: dict[str, Any], analysis: Analysis) -> Int[np.ndarray, "frames"]:
    """The true motion of every frame of the analysis, at its own rate."""
    rate = document["fps"]
    stretches = [Stretch(s["label"], s["start"] / rate, s["end"] / rate) for s in document["segments"]]
    return per_frame(stretches, analysis.frames, analysis.frame_rate)


def _read(name: str, data: bytes) -> Animation:
    return read_animation({name: data}, Parameters(), Limits.none(), lambda size: memoryview(bytearray(size)))
