"""How many motions are found in parts of takes that nobody made for it: another take, and another number, each.

    python -m benchmarks.real.parts ../shared/data/real

A folder as for `benchmarks.real`; its sheets are left out. Writes its table into docs/accuracy.md, or with `--print`
not.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.parts import Part, parts_of
from benchmarks.takes.real import real_takes
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut

Found = tuple[float, int, int]
"""Accuracy, the true number of motions, and the number found, nothing told."""


def measured(folder: Path) -> dict[tuple[str, str, str], list[Found]]:
    """Every part of every take of performers and games, by kind, part and half."""
    found: dict[tuple[str, str, str], list[Found]] = {}
    for number, take in enumerate(take for take in real_takes(folder) if take.kind != "sheets"):
        for name, part in parts_of(Part(take.truth, take.scored, take.recording()), number):
            labels = cut(part.recording.analysis(), Parameters()).labels
            key = take.kind, name, take.half
            found.setdefault(key, []).append((part.accuracy(labels), part.motions, len(np.unique(labels))))
    return found


def table(found: dict[tuple[str, str, str], list[Found]]) -> list[str]:
    """A line for each kind, part and half, and one for all."""
    lines = ["| parts | takes | accuracy | K exact | too many | too few |", "|---|---|---|---|---|---|"]
    lines += [line(f"{kind}, {name} | {half}", scores) for (kind, name, half), scores in sorted(found.items())]
    return [*lines, line("all | both halves", [score for scores in found.values() for score in scores])]


def line(name: str, scores: list[Found]) -> str:
    """What became of some parts."""
    accuracy = float(np.mean([score for score, _, _ in scores]))
    astray = np.array([count - true for _, true, count in scores])
    exact, many, few = ((astray == 0).sum(), (astray > 0).sum(), (astray < 0).sum())
    return f"| {name} | {accuracy:.3f} | {exact} of {len(scores)} | {many} | {few} |"


def main() -> None:
    """Prints and writes the table."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("folder", type=Path)
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    lines = table(measured(given.folder))
    print("\n".join(lines))
    if not given.print:
        write_section(ACCURACY, "parts", "\n".join(lines))


if __name__ == "__main__":
    main()
