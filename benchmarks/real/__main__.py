"""How well each method finds the motions of takes that nobody made for it: performed, played, and sheets of clips.

    python -m benchmarks.real ../shared/data/real --methods switching,aca,haca --invariance

A folder `performed`, `played` and `sheets` of takes with FILE.truth.json beside them. Of each kind every second take in
sorted order, from the first, is for development; the others are held out. Writes its tables into docs/accuracy.md, or
with `--print` not.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.reports.cuts import JudgedCuts, cut_table, true_cuts
from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.captured_bodies import on_other_bodies
from benchmarks.takes.real import HALVES, RealTake, real_takes
from benchmarks.takes.recordings import Recording, recorded_otherwise
from caesura.core.agreement import rand_index
from caesura.core.analysis import Analysis
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.core.registry.methods import METHODS
from caesura.core.repetition.repetitions import RepetitionFinder

NEAR_SECONDS = 0.3


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


def recordings(take: RealTake) -> Iterator[tuple[str, Recording]]:
    """The take as it is, by no name, and recorded otherwise; a captured one on other bodies too."""
    plain = take.recording()
    yield "", plain
    for name, change in recorded_otherwise().items():
        yield name, change(plain)
    if take.path.suffix == ".bvh":
        yield from on_other_bodies(take.path)


def invariance(take: RealTake) -> Iterator[tuple[str, float, bool]]:
    """For each change of the recording: how far the accuracy changes, nothing told, and whether K does."""
    plain: tuple[float, int] | None = None
    for name, recording in recordings(take):
        at = recording.frame_rate
        found = cut(recording.analysis(), Parameters())
        labels = found.labels[::-1] if name == "backwards" else found.labels
        labels = labels[int(at) : -int(at)] if name == "a second of rest" else labels
        rate = take.document["frame_rate"]
        frames = np.minimum(np.rint(np.arange(len(take.truth)) * at / rate), len(labels) - 1).astype(np.int64)
        accuracy = take.accuracy(labels[frames])
        if plain is not None:
            yield name, abs(accuracy - plain[0]), found.motions != plain[1]
        plain = plain or (accuracy, found.motions)


Score = tuple[float, float, bool]
"""Frame accuracy, Rand index (Eq. 6), and whether the number of motions is right."""


def scored(take: RealTake, analysis: Analysis, parameters: Parameters) -> Score:
    """One labelling of a take."""
    labels = cut(analysis, parameters).labels
    rand = rand_index(labels[take.scored], take.truth[take.scored])
    return take.accuracy(labels), rand, len(np.unique(labels)) == take.motions


def scores(take: RealTake, analysis: Analysis, methods: list[str]) -> Iterator[tuple[str, str, Score]]:
    """Every method on one take, told K and, where it can do without, nothing; the paper's from two rest poses."""
    for method in methods:
        told_only = METHODS[method].needs_motions
        for told in ("K told",) if told_only else ("K told", "nothing told"):
            asked = Parameters(method=method, motions=take.motions if told == "K told" else "auto")
            try:
                yield f"`{method}`", told, scored(take, analysis, asked)
                if method == "joint-entropy" and take.kind == "performed":
                    yield f"`{method}`, `rest=0`", told, scored(take, take.analysis(Parameters(rest=0)), asked)
            except ParameterError as refused:
                print(f"{take.path.name}, {method}: {refused}")


def measured(folder: Path, methods: list[str]) -> list[str]:
    """The tables of accuracies, of cuts and of repetitions."""
    found: dict[tuple[str, str, str], list[Score]] = {}
    cuts: dict[str, list[JudgedCuts]] = {}
    counted = np.zeros((2, 4), np.int64)
    for take in real_takes(folder):
        analysis = take.analysis()
        counted[HALVES.index(take.half)] += repetitions(take, analysis)
        cuts.setdefault(take.kind, []).append(JudgedCuts.of(analysis, *true_cuts(take)))
        for method, told, score in scores(take, analysis, methods):
            for kind in (take.kind, f"{take.kind}, {take.half}"):
                found.setdefault((kind, method, told), []).append(score)
    lines = ["| takes | method | told | accuracy | Rand index | K exact |", "|---|---|---|---|---|---|"]
    for (kind, method, told), each in sorted(found.items()):
        accuracy, rand, exact = (np.mean(values) for values in zip(*each, strict=True))
        right = round(exact * len(each))
        lines.append(f"| {kind} | {method} | {told} | {accuracy:.3f} | {rand:.3f} | {right} of {len(each)} |")
    lines += ["", *cut_table(cuts)]
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
    lines = measured(given.folder, given.methods.split(","))
    lines += ["", *changed(given.folder, given.invariance)] if given.invariance else []
    print("\n".join(lines))
    if not given.print:
        write_section(ACCURACY, "real", "\n".join(lines))


if __name__ == "__main__":
    main()
