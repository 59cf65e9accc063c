"""Sequences whose motions are known: what the methods are measured on."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Int

from benchmarks.choreography import HELD_BACK, choreography
from benchmarks.cmu import annotation, skinned
from core.analysis import Analysis
from core.formats.read import read_animation
from core.limits import Limits
from core.parameters import Parameters
from core.pipeline import analyse
from samples.figures import FIGURES, figure

DEVELOPMENT = frozenset({"fox_hard_0", "godotman_hard_0", "figure smooth", "figure rigid", "86_09"})
"""Takes on which the default method's constants were fixed; all others are reported on."""


@dataclass(frozen=True)
class Known:
    """One take, analysed, with its true motion per frame, and for captured ones the accepted range of each cut."""

    name: str
    group: str
    analysis: Analysis
    truth: Int[np.ndarray, "frames"]
    ranges: tuple[tuple[int, int], ...] = ()


def sequences(folder: Path | None, cmu: Path | None, *, figures: bool, held_back: int, threads: int) -> Iterator[Known]:
    """Captured trials, then FILE.glb beside FILE.truth.json, then the sample characters and made-up takes."""
    for motion in sorted(cmu.glob("*.amc") if cmu else ()):
        annotated = annotation((motion.parent / "mocap.txt").read_text(), motion.stem)
        analysis = analyse(skinned(motion.parent, motion.stem), Parameters(), threads=threads)
        frames = np.concatenate([annotated.frames, annotated.frames[-1:].repeat(analysis.frames)])[: analysis.frames]
        yield Known(motion.stem, "captured", analysis, frames, annotated.ranges[:-1])
    for name, glb, document in takes(folder, figures, held_back):
        animation = read_animation({f"{name}.glb": glb}, Parameters(), Limits.none(), _scratch)
        analysis = analyse(animation, Parameters(), threads=threads)
        yield Known(name, "development" if name in DEVELOPMENT else "reported", analysis, truth_of(document, analysis))


def takes(folder: Path | None, figures: bool, held_back: int) -> Iterator[tuple[str, bytes, dict[str, Any]]]:
    """Name, GLB and truth of every take that is no capture."""
    for truth in sorted(folder.glob("*.truth.json") if folder else ()):
        name = truth.name.removesuffix(".truth.json")
        yield name, truth.with_name(f"{name}.glb").read_bytes(), json.loads(truth.read_text())
    for name in FIGURES if figures else ():
        yield f"figure {name}", (sample := figure(name)).glb, sample.truth.document()
    for seed in HELD_BACK[:held_back]:
        yield f"seed {seed}", (sample := choreography(seed)).glb, sample.truth.document()


def truth_of(document: dict[str, Any], analysis: Analysis) -> Int[np.ndarray, "frames"]:
    """The true motion of every frame of the analysis, at its own rate."""
    numbers = {s["label"]: i for i, s in enumerate(document["segments"])}
    ends = np.array([segment["end"] for segment in document["segments"]])
    times = np.arange(analysis.frames) / analysis.frame_rate * document["fps"]
    which = np.searchsorted(ends, np.floor(times + 1e-6), side="right").clip(max=len(ends) - 1)
    return np.asarray(np.array([numbers[segment["label"]] for segment in document["segments"]])[which])


def _scratch(size: int) -> memoryview:
    return memoryview(bytearray(size))
