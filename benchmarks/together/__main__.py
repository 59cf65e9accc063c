"""How well one set of motions is found over several takes, a further take labelled, and a motion searched for.

    python -m benchmarks.together ../shared/data/real

Writes its tables into docs/together.md, or with `--print` not.
"""

import argparse
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from benchmarks.reports.report import DOCS, write_section
from benchmarks.together.collections import (
    PERFORMED,
    KnownTake,
    joint_accuracy,
    labelled_collection,
    performed_takes,
    true_motions,
)
from benchmarks.together.growth import growth_lines
from benchmarks.together.search import mean_average_precision, search_seconds
from caesura.core.together.segment_together import segment_together
from caesura.core.together.take_labelling import label_take

PAGE = DOCS / "together.md"


def accuracy_lines(collections: dict[str, list[KnownTake]]) -> Iterator[str]:
    """Joint accuracy, K told and not, and what each take by itself loses at most."""
    yield "| takes | motions | K told | nothing told | motions found | most that a take loses |"
    yield "|---|---|---|---|---|---|"
    for name, takes in collections.items():
        measured, count = [take.measured for take in takes], true_motions(takes)
        told, auto = segment_together(measured, count), segment_together(measured)
        loss = max(
            take.accuracy(take.own_labels) - take.accuracy(found.labels(take.measured.name))
            for take in takes
            for found in (told, auto)
        )
        yield (
            f"| {name} | {count} | {joint_accuracy(takes, told):.3f} | {joint_accuracy(takes, auto):.3f}"
            f" | {len(auto.motion_ids)} | {max(loss, 0.0):.3f} |"
        )


def added_lines(collections: dict[str, list[KnownTake]]) -> Iterator[str]:
    """One take left out of a labelled collection, then added to it."""
    yield "| takes, each added to the others | accuracy | least |"
    yield "|---|---|---|"
    for name, takes in collections.items():
        scores = [added_accuracy([*takes[:i], *takes[i + 1 :]], take) for i, take in enumerate(takes)]
        yield f"| {name} | {np.mean(scores):.3f} | {min(scores):.3f} |"


def added_accuracy(known: Sequence[KnownTake], take: KnownTake) -> float:
    """Frames whose motion is the one of that name, or, for what the others do not do, one new motion for each."""
    collection = labelled_collection(known)
    names = dict(collection.names)
    labels = label_take(collection, take.measured).collection.labels(take.measured.name)
    scored = take.truth != ""
    right = np.array([names.get(int(label)) == true for label, true in zip(labels, take.truth, strict=True)])
    for true in sorted(set(take.truth[scored].tolist()) - set(names.values())):
        new = labels[(take.truth == true) & (labels >= collection.next_id)]
        if len(new):
            right |= (take.truth == true) & (labels == np.bincount(new).argmax())
    return float(right[scored].mean())


def search_lines(collections: dict[str, list[KnownTake]], every: int) -> Iterator[str]:
    """Mean average precision by exercises, and the time of one search."""
    yield "| searched in | repetitions asked | mean average precision |"
    yield "|---|---|---|"
    for name, takes in collections.items():
        if all("repetitions" in take.document for take in takes):
            precision, asked = mean_average_precision(takes, every)
            yield f"| {name} | {asked} | {precision:.3f} |"
    seconds, busy, hours = search_seconds(next(iter(collections.values())))
    yield ""
    yield f"One repetition is searched for in {hours:.1f} hours of takes in {1000 * seconds:.0f} ms (median), which are"
    yield f"{1000 * busy:.0f} ms of processor."


def main() -> None:
    """Prints and writes the tables."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("folder", type=Path)
    options.add_argument("--every", type=int, default=1, metavar="N", help="search by every Nth repetition")
    options.add_argument("--growth", type=int, default=0, metavar="N", help="grow a collection up to N takes too")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    takes = performed_takes(given.folder)
    collections = {
        name: [take for stem, take in takes.items() if re.fullmatch(pattern, stem)]
        for name, pattern in PERFORMED.items()
    }
    lines = [*accuracy_lines(collections), "", *added_lines(collections), "", *search_lines(collections, given.every)]
    if given.growth:
        lines += ["", *growth_lines(list(takes.values()), given.growth)]
    print("\n".join(lines))
    if not given.print:
        write_section(PAGE, "together", "\n".join(lines))


if __name__ == "__main__":
    main()
