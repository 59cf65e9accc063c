"""How well each method finds the motions of takes that nobody made for it: performed, played, and sheets of clips.

    python -m benchmarks.real ../shared/data/real --methods switching,aca,haca --invariance

A folder `performed`, `played` and `sheets` of takes with FILE.truth.json beside them. Of each kind every second take in
sorted order, from the first, is for development; the others are held out. Writes its tables into docs/accuracy.md, or
with `--print` not.
"""

import argparse
import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int

from benchmarks.labelled import MODELS
from benchmarks.report import ACCURACY, write_section
from caesura.api import open_animation
from caesura.core.agreement import frame_accuracy
from caesura.core.analysis import Analysis
from caesura.core.errors import ParameterError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.core.registry.methods import METHODS
from caesura.core.repetition.repetitions import RepetitionFinder
from caesura.formats.read import read_animation

KINDS = ("performed", "played", "sheets")
HALVES = ("development", "held out")
NEAR_SECONDS = 0.3
NOISE = 0.0003
"""Of the size of the body."""

Vertices = Float[np.ndarray, "frames V 3"]


@dataclass(frozen=True)
class RealTake:
    """A take, its true motion per frame, which frames are scored, and the document of its truth."""

    path: Path
    kind: str
    half: str
    truth: Int[np.ndarray, "frames"]
    scored: Bool[np.ndarray, "frames"]
    document: dict[str, Any]

    @property
    def motions(self) -> int:
        """How many there truly are."""
        return len(np.unique(self.truth[self.scored]))

    def analysis(self) -> Analysis:
        """The analysed take."""
        data = {self.path.name: self.path.read_bytes()}
        return analyse(read_animation(data, Parameters(), Limits.none(), lambda size: memoryview(bytearray(size))))

    def accuracy(self, labels: Int[np.ndarray, "frames"]) -> float:
        """Frame accuracy over the scored frames."""
        return frame_accuracy(labels[self.scored], self.truth[self.scored])


def real_takes(folder: Path) -> Iterator[RealTake]:
    """Every take of the folder, by kind and name."""
    for kind in KINDS:
        files = sorted(f for f in (folder / kind).iterdir() if f.suffix in MODELS)
        names = [re.sub(r"_\d+fps$", "", path.stem) for path in files]  # one take at two rates is one take
        for path, name in zip(files, names, strict=True):
            document = json.loads(path.with_suffix("").with_suffix(".truth.json").read_text())
            motions = list(dict.fromkeys(s["label"] for s in document["segments"]))
            truth = np.full(document["segments"][-1]["end"], -1)
            for segment in document["segments"]:
                truth[segment["start"] : segment["end"]] = motions.index(segment["label"])
            scored = truth >= 0
            for start, end in document.get("unlabelled", ()):
                scored[start:end] = False
            half = HALVES[sorted(set(names)).index(name) % 2]
            yield RealTake(path, kind, half, truth, scored, document)


def repetitions(take: RealTake, analysis: Analysis) -> tuple[int, int, int, int]:
    """True segments, those whose repetitions are counted right, true repetitions, and ends found within 0.3 s."""
    found = RepetitionFinder.of(analysis)
    segments = exact = count = near = 0
    for segment in take.document["segments"] if "repetitions" in take.document else ():
        start, end = segment["start"], segment["end"]
        true = [r["end"] for r in take.document["repetitions"] if start <= (r["start"] + r["end"]) / 2 < end]
        ends = np.array([repeat.end for repeat in found.within(start, end)])
        near += sum(bool(np.abs(ends - e).min() <= NEAR_SECONDS * analysis.frame_rate) for e in true)
        segments, exact, count = segments + 1, exact + (len(ends) == len(true)), count + len(true)
    return segments, exact, count, near


def recorded_otherwise() -> dict[str, Callable[[Vertices, float], tuple[Vertices, float]]]:
    """The same take as another recording would have it."""

    def at(rate: float) -> Callable[[Vertices, float], tuple[Vertices, float]]:
        def resampled(vertices: Vertices, of: float) -> tuple[Vertices, float]:
            place = np.arange(int((len(vertices) - 1) / of * rate) + 1) * of / rate
            below = np.minimum(place.astype(np.int64), len(vertices) - 2)
            share = (place - below)[:, None, None]
            return vertices[below] * (1 - share) + vertices[below + 1] * share, rate

        return resampled

    def noisy(vertices: Vertices, rate: float) -> tuple[Vertices, float]:
        size = float(np.linalg.norm(np.ptp(vertices[0], axis=0)))
        return vertices + np.random.default_rng(1).normal(0, NOISE * size, vertices.shape), rate

    return {
        **{f"{rate} frames a second": at(rate) for rate in (24.0, 60.0, 120.0)},
        "mirrored": lambda vertices, rate: (vertices * [-1, 1, 1], rate),
        "in centimetres": lambda vertices, rate: (vertices * 100, rate),
        "noise of 0.0003": noisy,
        "a second of rest": lambda vertices, rate: (np.pad(vertices, ((int(rate),) * 2, (0, 0), (0, 0)), "edge"), rate),
        "backwards": lambda vertices, rate: (vertices[::-1], rate),
    }


def invariance(take: RealTake) -> Iterator[tuple[str, float, bool]]:
    """For each change of the recording: how far the accuracy changes, nothing told, and whether K does."""
    data = {take.path.name: take.path.read_bytes()}
    animation = read_animation(data, Parameters(), Limits.none(), lambda size: memoryview(bytearray(size)))
    vertices, rate = np.array(animation.vertices(0, animation.frames)), animation.frame_rate
    faces = animation.triangles if len(animation.triangles) else None
    plain: tuple[float, int] | None = None
    changes = {"": lambda vertices, rate: (vertices, rate), **recorded_otherwise()}
    for name, change in changes.items():
        changed, at = change(vertices, rate)
        found = cut(analyse(open_animation(changed.astype(np.float32), faces, frame_rate=at)), Parameters())
        labels = found.labels[::-1] if name == "backwards" else found.labels
        labels = labels[int(rate) : -int(rate)] if name == "a second of rest" else labels
        frames = np.minimum(np.rint(np.arange(len(take.truth)) * at / rate), len(labels) - 1).astype(np.int64)
        accuracy = take.accuracy(labels[frames])
        if plain is not None:
            yield name, abs(accuracy - plain[0]), found.motions != plain[1]
        plain = plain or (accuracy, found.motions)


def measured(folder: Path, methods: list[str], told_only: Callable[[str], bool]) -> list[str]:
    """The table of accuracies, and that of repetitions."""
    found: dict[tuple[str, str, str], list[tuple[float, bool]]] = {}
    counted = np.zeros((2, 4), np.int64)
    for take in real_takes(folder):
        analysis = take.analysis()
        counted[HALVES.index(take.half)] += repetitions(take, analysis)
        for method in methods:
            for told in ("K told",) if told_only(method) else ("K told", "nothing told"):
                asked = take.motions if told == "K told" else "auto"
                try:
                    labels = cut(analysis, Parameters(method=method, motions=asked)).labels
                except ParameterError as refused:
                    print(f"{take.path.name}, {method}: {refused}")
                    continue
                score = take.accuracy(labels), len(np.unique(labels)) == take.motions
                found.setdefault((take.kind, method, told), []).append(score)
                found.setdefault((f"{take.kind}, {take.half}", method, told), []).append(score)
    lines = ["| takes | method | told | accuracy | K exact |", "|---|---|---|---|---|"]
    for (kind, method, told), scores in sorted(found.items()):
        exact = sum(right for _, right in scores)
        accuracy = float(np.mean([score for score, _ in scores]))
        lines.append(f"| {kind} | `{method}` | {told} | {accuracy:.3f} | {exact} of {len(scores)} |")
    lines += ["", "| exercises | segments | repetitions counted right | ends within 0.3 s |", "|---|---|---|---|"]
    for half, (segments, exact, count, near) in zip(HALVES, counted.tolist(), strict=True):
        lines.append(f"| {half} | {segments} | {exact} | {near} of {count} |")
    return lines


def changed(folder: Path, every: int) -> list[str]:
    """The table of invariance, over every so manieth take of performers and games."""
    found: dict[str, list[tuple[float, bool]]] = {}
    for take in [take for take in real_takes(folder) if take.kind != "sheets"][::every]:
        for name, apart, differs in invariance(take):
            found.setdefault(name, []).append((apart, differs))
    lines = ["| recorded | mean change of accuracy | K changed |", "|---|---|---|"]
    for name, scores in found.items():
        apart = float(np.mean([score for score, _ in scores]))
        lines.append(f"| {name} | {apart:.4f} | {sum(d for _, d in scores)} of {len(scores)} |")
    return lines


def main() -> None:
    """Prints and writes the tables."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("folder", type=Path)
    options.add_argument("--methods", default="switching", help="which, separated by commas")
    options.add_argument("--invariance", type=int, default=0, metavar="N", help="every Nth take recorded otherwise")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    told_only = {name for name, method in METHODS.items() if method.needs_motions}.__contains__
    lines = measured(given.folder, given.methods.split(","), told_only)
    lines += ["", *changed(given.folder, given.invariance)] if given.invariance else []
    print("\n".join(lines))
    if not given.print:
        write_section(ACCURACY, "real", "\n".join(lines))


if __name__ == "__main__":
    main()
