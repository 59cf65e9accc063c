"""Compressed views that have lost a take: gone where nobody names them, told again shorter where much of one is gone.

An element whose bytes nobody names becomes as the one before it, which takes next to nothing. All others decode to the
bytes that they did, for what a filter makes of an element is its own alone.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from core.formats.clips.free_space import Range, places, views_of_others, whole_view
from core.formats.gltf.accessors import Accessors
from core.formats.gltf.document import COMPRESSED
from core.formats.gltf.meshopt.encoding.kernels import encoded

WORTH = 1024
"""Bytes that must be saved for a stream to be touched that somebody still names."""

Named = dict[int, list[Range]]


@dataclass(frozen=True)
class Stream:
    """Bytes [start, end) of the binary chunk, of which `data` are what is left; none of them where `view` is gone."""

    view: int
    extension: dict[str, Any]
    start: int
    end: int
    data: bytes


def shortened(
    json: dict[str, Any], accessors: Accessors, freed: Iterable[int], windows: Iterable[dict[str, Any]]
) -> list[Stream]:
    """The streams that shrink as `freed` accessors go and `windows` come."""
    if not json.get("bufferViews"):
        return []
    freed = set(freed)
    known = list(enumerate(json.get("accessors", [])))
    before = _named(accessor for number, accessor in known if number in freed)
    after = _named([*(accessor for number, accessor in known if number not in freed), *windows])
    streams = [_stream(json, view) for view in sorted(before.keys() - views_of_others(json) - _overlapping(json))]
    return [
        shorter
        for stream in filter(None, streams)
        for shorter in _shorter(stream, accessors, after.get(stream.view, []))
    ]


def _shorter(stream: Stream, accessors: Accessors, kept: list[Range]) -> Iterator[Stream]:
    """The stream, if it is worth it to touch it."""
    if not kept:
        yield stream
        return
    elements = accessors.coded(stream.view)
    if elements is None or not len(elements):
        return
    stride = elements.shape[1]
    named = np.zeros(len(elements), bool)
    for start, end in kept:
        named[start // stride : -(-end // stride)] = True
    sources = np.maximum.accumulate(np.where(named, np.arange(len(elements)), 0))
    data = encoded(elements[sources]).tobytes()
    if len(data) + WORTH <= stream.end - stream.start:
        yield Stream(stream.view, stream.extension, stream.start, stream.end, data)


def _stream(json: dict[str, Any], view: int) -> Stream | None:
    """What a view is decoded from, where it is a list of elements."""
    entry = json["bufferViews"][view]
    found = [entry.get("extensions", {}).get(name) for name in sorted(COMPRESSED)]
    extension = next(filter(None, found), None)
    if extension is None or "byteStride" in entry or extension["buffer"]:
        return None
    start = extension.get("byteOffset", 0)
    return Stream(view, extension, start, start + extension["byteLength"], b"")


def _overlapping(json: dict[str, Any]) -> set[int]:
    """Views that have bytes which another one has too."""
    found = sorted((*part, number) for number, view in enumerate(json["bufferViews"]) for part in whole_view(view))
    shared: set[int] = set()
    furthest = 0
    for (start, end, number), (next_start, _, _) in pairwise([*found, (2**63, 2**63, -1)]):
        if start < furthest or next_start < end:
            shared.add(number)
        furthest = max(furthest, end)
    return shared


def _named(accessors: Iterable[dict[str, Any]]) -> Named:
    """The parts of views that accessors are made of."""
    named: Named = {}
    for accessor in accessors:
        for view, start, size in places(accessor):
            named.setdefault(view, []).append((start, start + size))
    return named
