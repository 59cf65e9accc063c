"""Are repetitions counted right? On takes whose every segment is known to be performed so many times.

    python -m benchmarks.repetitions

The two sample figures, and choreographies and joined creatures kept back. Counted on the true cuts, and on the cuts
found with the number of motions told: there a segment counts if a true one ends within half a second of both its ends.
Writes its table into docs/accuracy.md, or with `--print` not.
"""

import argparse
from collections.abc import Iterator
from itertools import islice, pairwise

import numpy as np
from jaxtyping import Int

from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.sequences import Known, kept_back
from caesura.core.agreement import cut_frames
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.core.repetition.repetitions import RepetitionFinder, find_repetitions
from caesura.samples.sample_figures import FIGURES, build_figure

FIRST_SEED = 901
TOLERANCE_SECONDS = 0.5
HEAD = """| takes | segments | repeats counted right, true cuts | segments found | repeats counted right there |
|---|---|---|---|---|"""

Right = tuple[int, int]  # segments counted right, of so many


def on_true_cuts(known: Known) -> Right:
    """Segments whose repetitions are counted right."""
    found = find_repetitions(known.analysis.derived(RepetitionFinder.of), known.truth)
    return sum(len(r) == true for r, true in zip(found, known.repeats, strict=True)), len(known.repeats)


def on_found_cuts(known: Known) -> Right:
    """The same where the cuts are found too, among segments that are."""
    found = cut(known.analysis, Parameters(motions=known.motions))
    apart = TOLERANCE_SECONDS * known.analysis.frame_rate
    true = _bounds(known.truth)
    right = matched = 0
    for (start, end), repeated in zip(_bounds(found.labels), found.repeats, strict=True):
        for (true_start, true_end), times in zip(true, known.repeats, strict=True):
            if abs(start - true_start) <= apart and abs(end - true_end) <= apart:
                matched += 1
                right += len(repeated) == times
    return right, matched


def _bounds(labels: Int[np.ndarray, "frames"]) -> list[tuple[int, int]]:
    return list(pairwise([0, *cut_frames(labels).tolist(), len(labels)]))


def groups(count: int) -> Iterator[tuple[str, list[Known]]]:
    """The takes by kind."""
    yield "the sample figures", [Known.of_sample(name, "", build_figure(name)) for name in FIGURES]
    kept = list(islice(kept_back(FIRST_SEED), 2 * count))
    yield "figures, kept back", [known for known in kept if known.name.startswith("figures")]
    yield "creatures, kept back", [known for known in kept if known.name.startswith("creature")]


def row(name: str, of_them: list[Known]) -> str:
    """One line."""
    true, found = ([count(known) for known in of_them] for count in (on_true_cuts, on_found_cuts))
    (right, segments), (right_found, matched) = (np.sum(counts, axis=0).tolist() for counts in (true, found))
    shares = f"{right} ({right / segments:.0%}) | {matched} | {right_found} ({right_found / max(matched, 1):.0%})"
    return f"| {name} | {segments} | {shares} |"


def main() -> None:
    """Prints a line as soon as it is known, then writes them all."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--takes", type=int, default=8, help="takes of each kind that are kept back")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    lines = [HEAD]
    print(HEAD)
    everything = []
    for name, of_them in groups(given.takes):
        lines.append(row(name, of_them))
        print(lines[-1], flush=True)
        everything += of_them
    lines.append(row("all", everything))
    print(lines[-1])
    if not given.print:
        write_section(ACCURACY, "repetitions", "\n".join(lines))


if __name__ == "__main__":
    main()
