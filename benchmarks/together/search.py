"""Search by example: one repetition asked, and how early all others of the exercise come."""

import os
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from benchmarks.together.collections import KnownTake
from caesura.core.together.example_search import ExampleIndex, FoundRange
from caesura.core.together.pose_space import PoseSpace

MOST = 400
LEAST_OVERLAP = 0.5
"""Of the shorter of a range and a repetition: less, and the one does not find the other."""
HOURS = 10.0

Place = tuple[str, int, int, str]
"""A take, frames [start, end), and the exercise."""


def repetitions(takes: Sequence[KnownTake]) -> list[Place]:
    """Every repetition that the authors marked."""
    found = []
    for take in takes:
        for one in take.document.get("repetitions", ()):
            middle = (one["start"] + one["end"]) // 2
            found.append((take.measured.name, one["start"], one["end"], str(take.truth[middle])))
    return found


def make_index(takes: Sequence[KnownTake]) -> ExampleIndex:
    """The index of the takes in a space of their own."""
    named = [(take.measured.name, take.measured.poses) for take in takes]
    return ExampleIndex.of(PoseSpace.learn(named), named)


def mean_average_precision(takes: Sequence[KnownTake], every: int = 1) -> tuple[float, int]:
    """Over every so manieth repetition asked, and how many were. Ranges that overlap the one asked are left out."""
    index, places = make_index(takes), repetitions(takes)
    asked = places[::every]
    scores = []
    for place in asked:
        found = index.find(index.example(*place[:3]), MOST, threads=2)
        scores.append(average_precision(place, [other for other in places if other != place], found))
    return float(np.mean(scores)), len(asked)


def average_precision(asked: Place, others: list[Place], found: Sequence[FoundRange]) -> float:
    """Of the ranked ranges, for the other repetitions of the exercise; a repetition found twice is wrong once."""
    left = {other for other in others if other[3] == asked[3]}
    total, right, rank, gained = len(left), 0, 0, 0.0
    for one in found:
        if one.take == asked[0] and _overlap((one.start, one.end), asked[1:3]) > 0:
            continue
        rank += 1
        hit = next(
            (o for o in left if o[0] == one.take and _overlap((one.start, one.end), o[1:3]) >= LEAST_OVERLAP), None
        )
        if hit is not None:
            left.remove(hit)
            right += 1
            gained += right / rank
    return gained / total if total else 1.0


def search_seconds(takes: Sequence[KnownTake], hours: float = HOURS) -> tuple[float, float, float]:
    """The median time of a search by one repetition in so many hours of takes, on two threads, that of the processor,
    and the hours searched."""
    index, places = make_index(takes), repetitions(takes)
    once = sum(take.measured.seconds for take in takes) / 3600
    copies = int(np.ceil(hours / once))
    many = replace(
        index, takes=tuple(replace(one, name=f"{one.name} {copy}") for copy in range(copies) for one in index.takes)
    )
    many.find(index.example(*places[0][:3]), 50, threads=2)
    times, work = [], []
    for place in places[:: max(len(places) // 9, 1)]:
        example = index.example(*place[:3])
        began, busy = time.perf_counter(), time.process_time()
        many.find(example, 50, threads=min(os.cpu_count() or 1, 2))
        times.append(time.perf_counter() - began)
        work.append(time.process_time() - busy)
    return float(np.median(times)), float(np.median(work)), once * copies


def _overlap(one: tuple[int, int], other: tuple[int, int]) -> float:
    """Length of the intersection over that of the shorter."""
    shared = min(one[1], other[1]) - max(one[0], other[0])
    return max(shared, 0) / max(min(one[1] - one[0], other[1] - other[0]), 1)
