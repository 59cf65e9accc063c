"""How well each method finds the motions of takes whose truth is known.

    python -m benchmarks.accuracy ../shared/data/takes

Reads every FILE.glb that has a FILE.truth.json beside it, and with `--figures` the sample characters, and cuts each
by each method, told the number of motions and not told.
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Int

from core.agreement import adjusted_rand_index, boundary_scores, cuts_of, frame_accuracy
from core.analysis import Analysis
from core.formats.read import read_animation
from core.limits import Limits
from core.parameters import Parameters
from core.pipeline import analyse, cut
from samples.figures import FIGURES, figure

METHODS = ("joint-entropy", "switching")
TOLERANCES = (0.5, 0.15)


class Row(NamedTuple):
    """One take, one method, told K or not."""

    take: str
    method: str
    told: str
    accuracy: float
    rand: float
    boundary: tuple[float, ...]
    motions: int
    true_motions: int
    seconds: float


def takes(folder: Path | None, figures: bool) -> Iterator[tuple[str, bytes, dict[str, Any]]]:
    """Name, GLB and truth of every take."""
    for truth in sorted(folder.glob("*.truth.json") if folder else ()):
        name = truth.name.removesuffix(".truth.json")
        yield name, truth.with_name(f"{name}.glb").read_bytes(), json.loads(truth.read_text())
    for name in FIGURES if figures else ():
        sample = figure(name)
        yield f"figure {name}", sample.glb, sample.truth.document()


def rows(name: str, analysis: Analysis, truth: Int[np.ndarray, "frames"]) -> Iterator[Row]:
    """Each method on one take."""
    motions = len(np.unique(truth))
    for method in METHODS:
        for told, asked in (("K", motions), ("auto", "auto")):
            start = perf_counter()
            labels = cut(analysis, Parameters.parse({"method": method, "motions": asked})).labels
            seconds = perf_counter() - start
            boundary = tuple(
                boundary_scores(cuts_of(labels), cuts_of(truth), round(t * analysis.frame_rate)).f1 for t in TOLERANCES
            )
            found = len(np.unique(labels))
            accuracy, rand = frame_accuracy(labels, truth), adjusted_rand_index(labels, truth)
            yield Row(name, method, told, accuracy, rand, boundary, found, motions, seconds)


def truth_of(document: dict[str, Any], analysis: Analysis) -> Int[np.ndarray, "frames"]:
    """The true motion of every frame of the analysis, at its own rate."""
    numbers = {s["label"]: i for i, s in enumerate(document["segments"])}
    ends = np.array([segment["end"] for segment in document["segments"]])
    times = np.arange(analysis.frames) / analysis.frame_rate * document["fps"]
    which = np.searchsorted(ends, np.floor(times + 1e-6), side="right").clip(max=len(ends) - 1)
    return np.asarray(np.array([numbers[segment["label"]] for segment in document["segments"]])[which])


def table(results: list[Row]) -> str:
    """The rows, then the mean of each method."""
    head = "take                  method         told  accuracy    ARI  F1@0.5s  F1@0.15s  found/true  seconds"
    lines = [head, *map(_line, results)]
    for method in METHODS:
        for told in ("K", "auto"):
            of_it = [row for row in results if (row.method, row.told) == (method, told)]
            figures = [(r.accuracy, r.rand, *r.boundary, r.motions == r.true_motions, r.seconds) for r in of_it]
            accuracy, rand, wide, narrow, exact, seconds = np.mean(figures, axis=0)
            lines.append(
                f"{'mean of ' + str(len(of_it)):20}  {method:13}  {told:4}  {accuracy:8.3f}  {rand:5.3f}  {wide:7.3f}"
                f"  {narrow:8.3f}  {exact:9.0%}  {seconds:7.3f}"
            )
    return "\n".join(lines)


def _line(row: Row) -> str:
    return (
        f"{row.take:20}  {row.method:13}  {row.told:4}  {row.accuracy:8.3f}  {row.rand:5.3f}  {row.boundary[0]:7.3f}"
        f"  {row.boundary[1]:8.3f}  {row.motions:5}/{row.true_motions:<4}  {row.seconds:7.3f}"
    )


def main() -> None:
    """Reads the takes and prints the table."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("folder", type=Path, nargs="?", help="folder of FILE.glb with FILE.truth.json")
    options.add_argument("--figures", action="store_true", help="the sample characters too")
    options.add_argument("--threads", type=int, default=1)
    given = options.parse_args()
    results: list[Row] = []
    for name, glb, document in takes(given.folder, given.figures):
        animation = read_animation({f"{name}.glb": glb}, Parameters(), Limits.none(), _scratch)
        analysis = analyse(animation, Parameters(), threads=given.threads)
        if not results:  # compiled code is loaded by the first cut, which is not what is timed
            for method in METHODS:
                cut(analysis, Parameters.parse({"method": method}))
        results += rows(name, analysis, truth_of(document, analysis))
    if not results:
        options.error("nothing to measure: give a folder with takes and truths, or --figures")
    print(table(results))


def _scratch(size: int) -> memoryview:
    return memoryview(bytearray(size))


if __name__ == "__main__":
    main()
