"""Labels in a table: a row for each interval or for each frame."""

import csv
import math
from collections.abc import Iterable, Iterator

from caesura.service.commands.label_files.timed_labels import MOST_INTERVALS, TimedLabels

LABELS = ("motion", "label", "name")
"""Columns that hold the label, the first that is there."""
DELIMITERS = ",;\t"


def read_csv_labels(text: str) -> TimedLabels:
    """Columns `start` and `end` in frames, `start_seconds` and `end_seconds`, or `frame`; raises ValueError."""
    try:
        return _read_rows(text)
    except csv.Error as wrong:
        raise ValueError(str(wrong)) from None


def _read_rows(text: str) -> TimedLabels:
    head = text.partition("\n")[0]
    delimiter = max(DELIMITERS, key=head.count)
    rows = csv.reader(text.splitlines(), delimiter=delimiter, strict=True)
    columns = [name.strip().lower() for name in next(rows, [])]
    label = next((columns.index(name) for name in LABELS if name in columns), None)
    if label is None:
        raise ValueError(f"its first line names none of the columns {', '.join(LABELS)}")
    for start, end, unit in (("start", "end", "frames"), ("start_seconds", "end_seconds", "seconds")):
        if start in columns and end in columns:
            place = (columns.index(start), columns.index(end), label)
            return TimedLabels("frames" if unit == "frames" else "seconds", _intervals(rows, place, delimiter))
    if "frame" in columns:
        place = (columns.index("frame"), columns.index("frame"), label)
        return TimedLabels("frames", tuple(_runs(sorted(_intervals(rows, place, delimiter)))))
    raise ValueError("its first line names neither start and end, nor start_seconds and end_seconds, nor frame")


def _runs(frames: Iterable[tuple[float, float, str]]) -> Iterator[tuple[float, float, str]]:
    """Frames of one label, one after the other, as one interval."""
    start, end, label = -1.0, -1.0, ""
    for frame, _, name in frames:
        if (frame, name) == (end, label):
            end += 1
            continue
        if end >= 0:
            yield start, end, label
        start, end, label = frame, frame + 1, name
    yield start, end, label


def _intervals(
    rows: Iterable[list[str]], place: tuple[int, int, int], delimiter: str
) -> tuple[tuple[float, float, str], ...]:
    found: list[tuple[float, float, str]] = []
    for number, row in enumerate(rows, 2):
        if not any(cell.strip() for cell in row):
            continue
        if len(found) == MOST_INTERVALS * (10 if place[0] == place[1] else 1):
            raise ValueError(f"it has more than {len(found)} rows")
        try:
            start, end = (_number(row[column], delimiter) for column in place[:2])
            found.append((start, end, row[place[2]].strip()))
        except (ValueError, IndexError):
            raise ValueError(f"line {number} has no numbers where it should start and end, or no label") from None
    if not found:
        raise ValueError("it has no rows")
    return tuple(found)


def _number(text: str, delimiter: str) -> float:
    """A finite number; behind another delimiter a comma may stand for the point."""
    value = float(text.replace(",", ".") if delimiter != "," else text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value
