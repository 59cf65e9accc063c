"""How well each method finds the motions of takes whose truth is known.

    python -m benchmarks.accuracy ../shared/data/takes --cmu ../shared/data/cmu86 --figures --held-back 4 --seeds 3

Cuts every sequence by every method, told the number of motions K and, where the method can choose it, told nothing.
Methods with random starts run once for each seed. A folder holds models with their labels beside them, FILE.glb and
FILE.truth.json, FILE.json (a result document, corrected or not), FILE.csv or FILE.eaf. Writes the table into
docs/accuracy.md and the segments as bars into docs/pictures/accuracy.svg, or with `--print` neither.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter

from benchmarks.peers.peer_methods import PEERS, NotInstalled, Peers, peers
from benchmarks.reports.drawing import bars
from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.reports.scores import Row, Scores
from benchmarks.reports.table import HEAD, line, means, promises
from benchmarks.takes.sequences import Known, sequences
from caesura.core.analysis import Analysis
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.core.registry.methods import METHODS

RANDOM = frozenset(METHODS) - {"switching", "luo2014", "hmm"}
PAPER = "The paper's own figure 7, mean of 14 trials, K told: joint-entropy 0.903, SC 0.861, ACA 0.942, HACA 0.950."
FEATURES = {"joint-entropy": "strain", "clasp": "leading", "fluss": "leading"}
"""Of the others: both descriptors, strain and pair distances."""


def rows(known: Known, methods: list[str], seeds: int) -> Iterator[Row]:
    """Each method on one take, the paper's also from the first frame; one that refuses the take has no row."""
    for method in methods:
        yield from _rows(known, known.analysis, method, FEATURES.get(method, "both"), seeds)
        if method == "joint-entropy" and (other := known.from_first_frame()) is not None:
            yield from _rows(known, other, method, "strain,rest=0", seeds)


def _rows(known: Known, analysis: Analysis, method: str, features: str, seeds: int) -> Iterator[Row]:
    for told in ("K",) if METHODS[method].needs_motions else ("K", "auto"):
        asked = known.motions if told == "K" else "auto"
        found = []
        for seed in range(seeds if method in RANDOM else 1):
            start = perf_counter()
            try:
                labels = cut(analysis, Parameters(method=method, motions=asked, seed=seed)).labels
            except ParameterError as refused:
                print(f"{known.name}, {method}: {refused}")
                break
            found.append((labels, perf_counter() - start))
        if found:
            scores = tuple(Scores.of(labels, known, seconds) for labels, seconds in found)
            yield Row(known, method, told, features, scores, found[0][0])


def peer_rows(known: Known, names: list[str], others: Peers) -> Iterator[Row]:
    """Each peer on one take, or a line that says why not; one that is not installed is not asked again."""
    for name in list(names):
        try:
            labels, seconds = others.labels(name, known)
        except NotInstalled as missing:
            print(f"{name}: {missing}. See benchmarks/peers/requirements.txt")
            names.remove(name)
        else:
            scores = (Scores.of(labels, known, seconds),)
            yield Row(known, name, "K+cuts", FEATURES.get(name, "both"), scores, labels)


def measured(given: argparse.Namespace) -> tuple[list[Row], list[str]]:
    """Every row, printed as soon as it is known, and the peers that are missing."""
    found = []
    names = [name for name in given.peer_names.split(",") if name]
    asked = list(names)
    print(HEAD, flush=True)
    with peers(given.peers) as others:
        for known in sequences(
            given.folder, given.cmu, figures=given.figures, held_back=given.held_back, threads=given.threads
        ):
            for row in (*rows(known, given.methods.split(","), given.seeds), *peer_rows(known, names, others)):
                found.append(row)
                print(line(row), flush=True)
    return found, [name for name in asked if name not in names]


def section(found: list[Row], missing: list[str], command: str) -> str:
    """What is written: the promises, the means, then every line."""
    absent = f" Not installed where this was measured: {', '.join(missing)}." if missing else ""
    said = f"{PAPER} It was measured on bodies and trials that are not all to be had, so it stands beside the table."
    table = ["```", HEAD, *means(found), "", *map(line, found), "```"]
    return "\n".join([f"Written by `{command}`.", "", *promises(found), "", said + absent, "", *table])


def main() -> None:
    """Reads the takes, prints the table and writes it."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("folder", type=Path, nargs="?", help="folder of models with labels beside them")
    options.add_argument("--cmu", type=Path, help="folder of SUBJECT.asf, TRIAL.amc and mocap.txt")
    options.add_argument("--figures", action="store_true", help="the sample characters too")
    options.add_argument("--held-back", type=int, default=0, help="so many takes, made up by seeds nobody looked at")
    options.add_argument("--methods", default=",".join(METHODS), help="which, separated by commas")
    options.add_argument("--peers", default=sys.executable, metavar="PYTHON", help="the Python that has the peers")
    options.add_argument("--peer-names", default=",".join(PEERS), help="which, separated by commas")
    options.add_argument("--seeds", type=int, default=1, help="runs of methods with random starts")
    options.add_argument("--threads", type=int, default=1)
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    found, missing = measured(given)
    if not found:
        options.error("nothing to measure: give a folder with takes and labels, --cmu, --figures or --held-back")
    print("\n".join([*means(found), "", *promises(found)]))
    if not given.print:
        choices = ("--figures " if given.figures else "") + f"--held-back {given.held_back}"
        folders = ("TAKES " if given.folder else "") + ("--cmu CMU " if given.cmu else "")
        some = "" if given.methods == ",".join(METHODS) else f" --methods {given.methods}"
        command = f"python -m benchmarks.accuracy {folders}{choices} --seeds {given.seeds}{some}"
        write_section(ACCURACY, "accuracy", section(found, missing, command))
        told = [(row.known.name, row.method, row.known.truth, row.labels) for row in found if row.told != "auto"]
        (ACCURACY.parent / "pictures" / "accuracy.svg").write_text(bars(told))


if __name__ == "__main__":
    main()
