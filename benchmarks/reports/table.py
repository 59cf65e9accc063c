"""The table of accuracies: a line for every take and method, the means, and what was promised of them."""

import numpy as np

from benchmarks.reports.scores import ACCURACY, EXACT, HITS, MOTIONS, NARROW, SECONDS, WIDE, Row, mean, of

HEAD = (
    "take                      method         told    features       accuracy  ± sd   Rand   ARI    F1@10  F1@25  F1@50"
    "  F1@0.5s  F1@0.15s  K found/true  hits   seconds  seeds"
)
REPORTED = ("shared", "kept back")
"""Groups of takes on which no constant was fixed, but for the captured."""


def line(row: Row) -> str:
    """One take by one method: means over seeds."""
    values = row.means
    hits = f"{values[HITS]:.1f}/{len(row.known.ranges)}" if row.known.ranges else "-"
    spread = float(np.std([scores.accuracy for scores in row.scores]))
    return _text(row.known.name, row, values, spread, f"{values[MOTIONS]:g}/{row.known.motions}", hits)


def means(rows: list[Row]) -> list[str]:
    """The mean of each method over each group of takes, over those reported, and over all."""
    groups = {group: (group,) for group in dict.fromkeys(row.known.group for row in rows)}
    wanted = {**groups, "reported": REPORTED, "in all": tuple(groups)}
    lines = []
    for name, included in wanted.items():
        for method, told, features in dict.fromkeys((row.method, row.told, row.features) for row in rows):
            of_it = [row for row in of(rows, method, told, *included) if row.features == features]
            if of_it:
                lines.append(_mean(name, of_it))
    return lines


def _mean(group: str, rows: list[Row]) -> str:
    """Deviation: between seeds, of the mean over the takes."""
    values = np.array([row.means for row in rows])
    seeds = min(len(row.scores) for row in rows)
    between = float(np.std([np.mean([row.scores[seed].accuracy for row in rows]) for seed in range(seeds)]))
    ranges = sum(len(row.known.ranges) for row in rows)
    hits = f"{values[:, HITS].sum():.1f}/{ranges}" if ranges else "-"
    exact = f"{values[:, EXACT].mean():.0%} exact"
    return _text(f"mean of {len(rows)} {group}", rows[0], values.mean(axis=0), between, exact, hits)


def _text(name: str, row: Row, values: np.ndarray, deviation: float, motions: str, hits: str) -> str:
    accuracy, rand, adjusted, tenth, quarter, half, wide, narrow = values[:MOTIONS]
    return (
        f"{name:24}  {row.method:13}  {row.told:6}  {row.features:13}  {accuracy:8.3f}  {deviation:.3f}  {rand:.3f}"
        f"  {adjusted:.3f}  {tenth:.3f}  {quarter:.3f}  {half:.3f}  {wide:7.3f}  {narrow:8.3f}"
        f"  {motions:>12}  {hits:>6}  {values[SECONDS]:7.2f}  {len(row.scores):5}"
    )


def promises(rows: list[Row]) -> list[str]:
    """What the default method is to show, and what it showed; a line is left out where its takes are."""
    captured = of(rows, "switching", "K", "captured")
    told, unasked = (of(rows, "switching", t, *REPORTED) for t in ("K", "auto"))
    peer = of(rows, "kernel-cpd", "K+cuts", *REPORTED)
    lines = []
    if captured:
        hits = sum(float(row.means[HITS]) for row in captured)
        ranges = sum(len(row.known.ranges) for row in captured)
        lines.append(f"| captured | mean frame accuracy, K told | 0.965 | {mean(captured, ACCURACY):.3f} |")
        lines.append(f"| captured | true cuts hit inside the annotated range | 8 of 10 | {hits:.0f} of {ranges} |")
    if told:
        beside = f"{mean(peer, ACCURACY):.3f}" if peer else "not measured"
        exact = f"{sum(row.means[EXACT] for row in unasked):.0f} of {len(unasked)}"
        lines += [
            f"| reported | mean frame accuracy, K told | 0.985 | {mean(told, ACCURACY):.3f} |",
            f"| reported | the same of KernelCPD, told the cuts | less | {beside} |",
            f"| reported | mean frame accuracy, nothing told | 0.96 | {mean(unasked, ACCURACY):.3f} |",
            f"| reported | number of motions exact, nothing told | 5 of 6 | {exact} |",
            f"| reported | boundary F1 within 0.15 s, K told | 0.95 | {mean(told, NARROW):.3f} |",
            f"| reported | boundary F1 within 0.5 s, K told | - | {mean(told, WIDE):.3f} |",
        ]
    return ["| takes | measure | at least | measured |", "|---|---|---|---|", *lines] if lines else []
