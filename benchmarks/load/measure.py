"""One measured figure, what was promised of it, and the table of all."""

from collections.abc import Iterable, Sequence
from math import ceil
from typing import NamedTuple


class Measure(NamedTuple):
    """What was measured, how much it came to, and the promise: `most` or `least`; without both it is only told."""

    name: str
    value: float
    unit: str = ""
    most: float | None = None
    least: float | None = None

    @property
    def kept(self) -> bool:
        """Whether the promise is kept."""
        return (self.most is None or self.value <= self.most) and (self.least is None or self.value >= self.least)


def table(measures: Iterable[Measure]) -> str:
    """As Markdown; what misses its promise says so."""
    lines = ["| measure | found | promised | |", "|---|---:|---:|---|"]
    for one in measures:
        promise = f"≤ {one.most:g}" if one.most is not None else f"≥ {one.least:g}" if one.least is not None else ""
        found = f"{one.value:,.0f}" if one.value >= 100 else f"{one.value:.2g}" if one.value < 1 else f"{one.value:.1f}"
        lines.append(f"| {one.name} | {found} {one.unit} | {promise} | {'' if one.kept else 'missed'} |")
    return "\n".join(lines)


def percentile(values: Sequence[float], share: float) -> float:
    """The least value that so much of them does not exceed: 0.5 is the median of an odd number."""
    ordered = sorted(values)
    return ordered[max(ceil(share * len(ordered)) - 1, 0)]
