"""The header of an FBX: the names and times of its takes, its rate and size, as far as they are plain. Light: no NumPy.

Of a text, the beginning and the end are looked at, where they stand.
"""

import re
from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.file_type import Format
from caesura.formats.native.fbx.records import MAGIC, Property, Record, RecordWalker
from caesura.formats.takes.frame_rate import ASSUMED, count_frames
from caesura.formats.takes.take_selection import take_name
from caesura.formats.upload_summary import MOST_FRAMES, MOST_JSON, Header, HeaderTake

TICKS = 46_186_158_000
"""Of the format's clock in a second."""

RATES = (
    30.0, 120.0, 100.0, 60.0, 50.0, 48.0, 30.0, 30.0, 29.97, 29.97, 25.0, 24.0, 1000.0, 23.976, 0.0, 96.0, 72.0, 59.94,
)  # fmt: skip
"""Frames per second by `TimeMode`; mode 14 has a rate of its own."""

CUSTOM = 14
TAKE = re.compile(
    rb'^[ \t]*Take: "([^"\n]{0,400})"[^\n]*\n(?:[^\n]*\n){0,4}?[ \t]*LocalTime: (-?\d{1,18}), ?(-?\d{1,18})',
    re.MULTILINE,
)
TIME_MODE = re.compile(rb'"TimeMode"[^\n]{0,80}, ?(\d{1,3})\r?$', re.MULTILINE)
POINTS = re.compile(rb"^[ \t]*Vertices: \*(\d{1,12})", re.MULTILINE)

Span = tuple[str, int, int]
"""A take's name, and where it begins and ends, in ticks."""


def fbx_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of an FBX."""
    size = file.seek(0, 2)
    file.seek(0)
    if file.read(len(MAGIC)) == MAGIC:
        spans, rate, vertices, corners = _summarise_records(RecordWalker(file))
    else:
        file.seek(0)
        text = file.read(MOST_JSON)
        file.seek(max(size - MOST_JSON, 0))
        tail = file.read(MOST_JSON)
        spans = [(found[1].decode("utf-8", "replace"), int(found[2]), int(found[3])) for found in TAKE.finditer(tail)]
        modes = TIME_MODE.search(text)
        rate = _rate(int(modes[1]) if modes else 0, 0.0)
        vertices = sum(int(found[1]) for found in POINTS.finditer(text)) // 3
        corners = 4 * vertices
    limits.check("max_takes", len(spans))
    takes = tuple(_take(place, span, rate) for place, span in enumerate(spans))
    # A closed surface has twice as many triangles as vertices; one of separate polygons has fewer.
    return Header(kind, name, takes, vertices, min(2 * vertices, corners // 2))


def _take(place: int, span: Span, rate: float) -> HeaderTake:
    name, begin, end = span
    seconds = max(end - begin, 0) / TICKS
    return HeaderTake(place, take_name(name, place), seconds, int(min(count_frames(seconds, rate), MOST_FRAMES)), rate)


def _rate(mode: Property, custom: Property) -> float:
    rate = custom if mode == CUSTOM else RATES[mode] if isinstance(mode, int) and 0 <= mode < len(RATES) else ASSUMED
    return float(rate) if isinstance(rate, int | float) and 0 < rate <= max(RATES) else ASSUMED


def _summarise_records(walker: RecordWalker) -> tuple[list[Span], float, int, int]:
    """Takes, rate, vertices, and corners of polygons."""
    takes: list[Span] = []
    stacks: list[Span] = []
    rate, vertices, corners = ASSUMED, 0, 0
    for record in walker.top():
        if record.name == "GlobalSettings":
            settings = _settings(walker, record)
            rate = _rate(settings.get("TimeMode"), settings.get("CustomFrameRate"))
        elif record.name == "Takes":
            takes = [_span_of_take(walker, inner) for inner in walker.within(record) if inner.name == "Take"]
        for inner in walker.within(record) if record.name == "Objects" else (record,):
            if inner.name == "AnimationStack":
                stacks.append(_span_of_stack(walker, inner))
            elif inner.name in {"Geometry", "Model"} and walker.properties(inner)[-1:] != ["Shape"]:
                points, found = _size(walker, inner)
                vertices, corners = vertices + points, corners + found
    return stacks or takes, rate, vertices, corners


def _settings(walker: RecordWalker, record: Record) -> dict[str, Property]:
    """The properties that are stored as a list of names and values: the value is the last of each."""
    lists = [inner for inner in walker.within(record) if inner.name in {"Properties70", "Properties60"}]
    rows = [walker.properties(inner) for found in lists for inner in walker.within(found)]
    return {str(row[0]): row[-1] for row in rows if len(row) > 1}


def _span_of_take(walker: RecordWalker, record: Record) -> Span:
    names = walker.properties(record)
    times = next((walker.properties(inner) for inner in walker.within(record) if inner.name == "LocalTime"), [])
    begin, end = [*times, 0, 0][:2]
    return _text(names[:1]), _ticks(begin), _ticks(end)


def _span_of_stack(walker: RecordWalker, record: Record) -> Span:
    settings = _settings(walker, record)
    name = _text(walker.properties(record)[1:2]).partition("\0")[0]
    return name, _ticks(settings.get("LocalStart")), _ticks(settings.get("LocalStop"))


def _size(walker: RecordWalker, record: Record) -> tuple[int, int]:
    """Vertices of a mesh, and corners of its polygons: in old versions a property each, in later ones an array."""
    found = {"Vertices": 0, "PolygonVertexIndex": 0}
    for inner in walker.within(record):
        if inner.name in found:
            count = _ticks((walker.properties(inner) or [0])[0]) if inner.count == 1 else inner.count
            found[inner.name] = min(max(count, 0), MOST_FRAMES)
    return found["Vertices"] // 3, found["PolygonVertexIndex"]


def _ticks(value: Property) -> int:
    return value if type(value) is int else 0


def _text(values: list[Property]) -> str:
    return values[0] if values and isinstance(values[0], str) else ""
