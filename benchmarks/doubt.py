"""Are the wrong cuts those that the method is least sure of, and the missed ones among its candidates?

    python -m benchmarks.doubt

A cut is wrong that is farther than 0.15 s (and in a second row 0.5 s) from every true cut. Takes are cut with the
number of motions not told; `pooled` sorts the cuts of all takes together, `per take` those of each take with a wrong
one, and means over them. A true cut is missed that no cut is within the same time of, and proposed where a candidate
is within half a second. In `brisk` takes a segment lasts 1.5 to 4 s: there more goes wrong. All takes are kept back:
the formula of the confidence was chosen on others. Writes its table into docs/accuracy.md, or with `--print` not.
"""

import argparse
from collections.abc import Iterator
from itertools import islice
from math import ceil

import numpy as np
from jaxtyping import Bool, Float

from benchmarks.reports.cuts import NEAR_SECONDS, JudgedCuts
from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.sequences import Known, kept_back
from caesura.core.agreement import cut_frames

FIRST_SEED = 1301
FIFTH = 0.2
BRISK_SECONDS = (1.5, 4.0)
TOLERANCES_SECONDS = (0.15, 0.5)
LEAST_CUTS = 5
"""A take of fewer has no fifth."""
HEAD = (
    "| takes | wrong beyond | cuts | wrong | in the least sure fifth, pooled | per take | below 0.5: wrong, right"
    " | missed | proposed |\n|---|---|---|---|---|---|---|---|---|"
)


def judged(known: Known) -> JudgedCuts:
    """Every cut of a take."""
    true = cut_frames(known.truth)
    return JudgedCuts.of(known.analysis, true, true)


def share_in_least_fifth(confidence: Float[np.ndarray, "cuts"], wrong: Bool[np.ndarray, "cuts"]) -> float:
    """Of the wrong cuts, those among the fifth with the least confidence; in order of time where that is equal."""
    least = np.argsort(confidence, kind="stable")[: ceil(FIFTH * len(confidence))]
    return float(wrong[least].sum() / wrong.sum())


def row(name: str, takes: list[JudgedCuts], tolerance: float) -> str:
    """One line."""
    sure, apart = (np.concatenate([getattr(take, of) for take in takes]) for of in ("confidence", "astray"))
    wrong = apart > tolerance
    judgeable = [t for t in takes if len(t.confidence) >= LEAST_CUTS and (t.astray > tolerance).any()]
    each = [share_in_least_fifth(take.confidence, take.astray > tolerance) for take in judgeable]
    pooled = f"{share_in_least_fifth(sure, wrong):.0%}" if wrong.any() else "-"
    per_take = f"{np.mean(each):.0%} of {len(each)}" if each else "-"
    low = sure < 0.5
    flagged = f"{low[wrong].mean():.0%}, {low[~wrong].mean():.0%}" if wrong.any() else f"-, {low.mean():.0%}"
    missed = np.concatenate([take.missed_by for take in takes]) > tolerance
    proposed = (np.concatenate([take.proposed_by for take in takes])[missed] <= max(tolerance, NEAR_SECONDS)).sum()
    counts = f"{len(sure)} | {wrong.sum()} | {pooled} | {per_take} | {flagged} | {missed.sum()}"
    return f"| {name} | {tolerance:g} s | {counts} | {proposed} of {sum(take.candidates for take in takes)} |"


def groups(count: int) -> Iterator[tuple[str, list[JudgedCuts]]]:
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
