"""A collection that grows: what cutting all together, adding one take and searching cost at 10, 100 and 1,000 takes."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from benchmarks.together.collections import KnownTake
from caesura.core.together.collection_file import collection_to_bytes
from caesura.core.together.example_search import ExampleIndex
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.segment_together import segment_together
from caesura.core.together.take_labelling import label_take

SECONDS = 36.0
NOISE = 0.01
"""Of the body: no copy is the same."""
REPEATS = 5


def growth_lines(takes: Sequence[KnownTake], most: int) -> Iterator[str]:
    """A table with a row for each size of a collection of exercises in pieces of 36 seconds."""
    pieces = [piece for take in takes if "repetitions" in take.document for piece in _pieces(take.measured)]
    yield "| takes | hours | segments | cut together | one take more | search | collection | index |"
    yield "|---|---|---|---|---|---|---|---|"
    size = 10
    while size <= most:
        yield _row([_copied(pieces, number) for number in range(size + REPEATS)])
        size *= 10


def _row(takes: list[MeasuredTake]) -> str:
    held, added = takes[:-REPEATS], takes[-REPEATS:]
    began = time.perf_counter()
    collection = segment_together(held)
    together = time.perf_counter() - began
    times = []
    for take in added:
        began = time.perf_counter()
        label_take(collection, take)
        times.append(time.perf_counter() - began)
    index = ExampleIndex.of(collection.space, [(take.name, take.poses) for take in held])
    frames = round(3 * held[0].poses.frame_rate)
    searches = []
    for take in held[:REPEATS]:
        began = time.perf_counter()
        index.find(index.example(take.name, 0, frames), 50, threads=2)
        searches.append(time.perf_counter() - began)
    hours = sum(take.seconds for take in held) / 3600
    stored = len(collection_to_bytes(collection)) / 1e6
    searched = sum(take.values.nbytes for take in index.takes) / 1e6
    return (
        f"| {len(held)} | {hours:.2f} | {len(collection.segments)} | {together:.2f} s | {np.median(times):.3f} s"
        f" | {1000 * np.median(searches):.0f} ms | {stored:.1f} MB | {searched:.1f} MB |"
    )


def _pieces(take: MeasuredTake) -> list[MeasuredTake]:
    """A take in pieces of `SECONDS`, each with the segments that lie in it."""
    length = round(SECONDS * take.poses.frame_rate) // take.poses.stride * take.poses.stride
    found = []
    for start in range(0, take.poses.frames - length + 1, length):
        inner = take.bounds[(take.bounds > start) & (take.bounds < start + length)] - start
        bounds = np.concatenate([[0], inner, [length]])
        own = take.motions[np.searchsorted(take.bounds, bounds[:-1] + start, "right") - 1]
        steps = slice(start // take.poses.stride, (start + length) // take.poses.stride)
        poses = replace(take.poses, places=take.poses.places[steps], frames=length)
        found.append(MeasuredTake("", poses, bounds, own, np.ones(len(own), np.int64)))
    return found


def _copied(pieces: list[MeasuredTake], number: int) -> MeasuredTake:
    """One of the pieces with a name and a stance of its own."""
    piece = pieces[number % len(pieces)]
    stance = np.random.default_rng(number).normal(0, NOISE, piece.poses.places.shape[1:])
    places = (piece.poses.places + stance).astype(np.float32)
    return replace(piece, name=f"take {number}", poses=replace(piece.poses, places=places))
