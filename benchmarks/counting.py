"""How many motions are found where nobody says how many there are: 3, 8, 15 and 30 of them, and long sessions.

    python -m benchmarks.counting ../shared/data/gltf/Fox.glb ../shared/data/gltf/godotman.glb

Figures perform choreographies, creatures and the files given are joined from their clips (as many as they have), all
by seeds that nobody looked at; the long sessions are of 12,000 and 72,000 frames. Writes its table into
docs/accuracy.md, or with `--print` not.
"""

import argparse
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from time import perf_counter

import numpy as np

from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.joining import joined
from benchmarks.takes.sequences import Known, kept_back
from caesura.core.agreement import frame_accuracy
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.samples.long_session import long_session

COUNTS = (3, 8, 15, 30)
FIRST_SEED = 1001
"""Takes of seeds below were looked at while constants were fixed."""
ALLOWED = 0.1
"""Of the true number: farther off is a miss."""
HEAD = """| take | frames | motions | found | | frame accuracy | s to cut |
|---|---|---|---|---|---|---|"""


def takes(files: list[Path], first: int, seeds: int, sessions: list[int]) -> Iterator[Known]:
    """Every take, one at a time: long ones need room."""
    for count in COUNTS:
        yield from islice(kept_back(first + 10 * count, motions=count), 2 * seeds)
    for file in files:
        for seed in range(first, first + seeds):
            made = joined(file.name, file.read_bytes(), COUNTS[-1], seed)
            yield Known.of_joined(f"{file.stem} {seed}", "joined", made)
    for frames in sessions:
        yield Known.of_sample(f"session of {frames:,}", "session", long_session(frames))


def row(known: Known) -> tuple[str, int, int]:
    """One line, the true number of motions and the number found."""
    start = perf_counter()
    found = cut(known.analysis, Parameters())
    seconds = perf_counter() - start
    accuracy = frame_accuracy(found.labels, known.truth)
    said = f"{known.analysis.frames:,} | {known.motions} | {found.motions} | {verdict(known.motions, found.motions)}"
    return f"| {known.name} | {said} | {accuracy:.3f} | {seconds:.2f} |", known.motions, found.motions


def verdict(true: int, found: int) -> str:
    """Exact, within a tenth, or how many too many."""
    if found == true:
        return "exact"
    return "within 10 %" if abs(found - true) <= ALLOWED * true else f"{found - true:+d}"


def summary(counts: list[tuple[int, int]]) -> str:
    """How many are exact, and how many within a tenth."""
    verdicts = [verdict(true, found) for true, found in counts]
    exact, near = verdicts.count("exact"), verdicts.count("exact") + verdicts.count("within 10 %")
    error = float(np.mean([abs(found - true) / true for true, found in counts]))
    return (
        f"Exact on {exact} of {len(counts)} takes, exact or within 10 % on {near}; {error:.1%} off in the mean."
        if counts
        else "No take."
    )


def main() -> None:
    """Prints a line as soon as it is known, then writes them all."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("files", type=Path, nargs="*", help="glTF files with several clips, to be joined")
    options.add_argument("--first-seed", type=int, default=FIRST_SEED, help="of the takes that seeds make")
    options.add_argument("--seeds", type=int, default=3, help="takes of each kind and number")
    options.add_argument("--sessions", default="12000,72000", help="frames of the long sessions, by commas")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    print(HEAD)
    lines, counts = [], []
    for known in takes(given.files, given.first_seed, given.seeds, [int(n) for n in given.sessions.split(",") if n]):
        line, true, found = row(known)
        print(line, flush=True)
        lines.append(line)
        counts.append((true, found))
    print(summary(counts))
    if not given.print:
        write_section(ACCURACY, "counting", "\n".join([HEAD, *lines, "", summary(counts)]))


if __name__ == "__main__":
    main()
