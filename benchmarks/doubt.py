"""Are the wrong cuts those that the method is least sure of?

    python -m benchmarks.doubt

A cut is wrong that is farther than 0.15 s (and in a second row 0.5 s) from every true cut. Takes are cut with the
number of motions not told; `pooled` sorts the cuts of all takes together, `per take` those of each take with a wrong
one, and means over them. In `brisk` takes a segment lasts 1.5 to 4 s: there more goes wrong. All takes are kept back:
the formula of the confidence was chosen on others. Writes its table into docs/accuracy.md, or with `--print` not.
"""

import argparse
from collections.abc import Iterator
from itertools import islice
from math import ceil

import numpy as np
from jaxtyping import Bool, Float

from benchmarks.report import ACCURACY, write_section
from benchmarks.sequences import Known, kept_back
from caesura.core.agreement import cut_frames
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut

FIRST_SEED = 1301
FIFTH = 0.2
BRISK_SECONDS = (1.5, 4.0)
TOLERANCES_SECONDS = (0.15, 0.5)
LEAST_CUTS = 5
"""A take of fewer has no fifth."""
HEAD = """| takes | wrong beyond | cuts | wrong | in the least sure fifth, pooled | per take | below 0.5: wrong, right |
|---|---|---|---|---|---|---|"""

Judged = tuple[Float[np.ndarray, "cuts"], Float[np.ndarray, "cuts"]]
"""The confidence of every cut, and how many seconds it is from the nearest true one."""


def judged(known: Known) -> Judged:
    """Every cut of a take."""
    found = cut(known.analysis, Parameters())
    apart = np.abs(found.cuts[:, None] - cut_frames(known.truth)[None]).min(axis=1, initial=known.analysis.frames)
    return found.confidence, apart / known.analysis.frame_rate


def share_in_least_fifth(confidence: Float[np.ndarray, "cuts"], wrong: Bool[np.ndarray, "cuts"]) -> float:
    """Of the wrong cuts, those among the fifth with the least confidence; in order of time where that is equal."""
    least = np.argsort(confidence, kind="stable")[: ceil(FIFTH * len(confidence))]
    return float(wrong[least].sum() / wrong.sum())


def row(name: str, takes: list[Judged], tolerance: float) -> str:
    """One line."""
    sure, apart = (np.concatenate(parts) for parts in zip(*takes, strict=True))
    wrong = apart > tolerance
    each = [share_in_least_fifth(c, a > tolerance) for c, a in takes if len(c) >= LEAST_CUTS and (a > tolerance).any()]
    pooled = f"{share_in_least_fifth(sure, wrong):.0%}" if wrong.any() else "-"
    per_take = f"{np.mean(each):.0%} of {len(each)}" if each else "-"
    low = sure < 0.5
    flagged = f"{low[wrong].mean():.0%}, {low[~wrong].mean():.0%}" if wrong.any() else f"-, {low.mean():.0%}"
    return f"| {name} | {tolerance:g} s | {len(sure)} | {wrong.sum()} | {pooled} | {per_take} | {flagged} |"


def groups(count: int) -> Iterator[tuple[str, list[Judged]]]:
    """The takes by kind."""
    yield "as kept back", [judged(known) for known in islice(kept_back(FIRST_SEED), 2 * count)]
    brisk = kept_back(FIRST_SEED + 100, seconds=BRISK_SECONDS)
    yield "brisk", [judged(known) for known in islice(brisk, 2 * count)]


def main() -> None:
    """Prints and writes the table."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--takes", type=int, default=20, help="takes of each kind")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    of_kinds = dict(groups(given.takes))
    of_kinds["all"] = [take for takes in of_kinds.values() for take in takes]
    lines = [HEAD, *(row(name, takes, t) for name, takes in of_kinds.items() for t in TOLERANCES_SECONDS)]
    print("\n".join(lines))
    if not given.print:
        write_section(ACCURACY, "doubt", "\n".join(lines))


if __name__ == "__main__":
    main()
