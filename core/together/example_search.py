"""Search by example: ranges of takes that are like a range of one of them, each bent in time onto the other."""

from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.errors import ParameterError
from caesura.core.kernels.time_warping import warp_onto_ranges
from caesura.core.single_threaded_blas import single_threaded_blas
from caesura.core.together.body_poses import BodyPoses
from caesura.core.together.pose_space import PoseSpace

STEPS_PER_SECOND = 7.5
"""Of the takes that are searched."""
MOST_SAMPLES = 48
"""Of an example: longer ones are looked at more coarsely, takes with them."""
SPEED_WEIGHT = 1.5
"""Seconds: a difference in speed counts so much, against one of pose. A stance is a habit, a speed is none."""
BEND = 0.05
"""What a step costs at which one of the two goes twice as fast as the other."""
LEAST_SECONDS = 0.3
"""Of an example."""
MOST_OVERLAP = 0.5
"""Of the shorter of two ranges: more, and the nearer one alone counts."""
TAKES_AT_ONCE = 16
"""Are searched by a thread before it asks for more: asking takes as long as a short take."""
ENOUGH = 4
"""Times as many candidates of each take as ranges are wanted of all."""


@dataclass(frozen=True)
class FoundRange:
    """Frames [start, end) of a take, and how unlike they are to the example: 0 is the same, 1 is as unlike as two
    poses at random. `mirrored`: left and right are exchanged.
    """

    take: str
    start: int
    end: int
    distance: float
    mirrored: bool = False


@dataclass(frozen=True)
class IndexedTake:
    """The poses of a take as they are searched, `stride` frames of it a step."""

    name: str
    values: Float32[np.ndarray, "steps D"]
    frames: int
    stride: int
    frame_rate: float


@dataclass(frozen=True)
class ExampleIndex:
    """All that a search needs of a collection's takes: about 1.4 MB an hour. It is made once and searched often."""

    space: PoseSpace
    takes: tuple[IndexedTake, ...]

    @classmethod
    def of(cls, space: PoseSpace, takes: Iterable[tuple[str, BodyPoses]]) -> "ExampleIndex":
        """Of takes with their names, in the space of their collection."""
        return cls(space, tuple(index_take(space, name, poses) for name, poses in takes))

    def with_take(self, name: str, poses: BodyPoses) -> "ExampleIndex":
        """The same with one take more."""
        return ExampleIndex(self.space, (*self.takes, index_take(self.space, name, poses)))

    def without_take(self, name: str) -> "ExampleIndex":
        """The same with one take less."""
        return ExampleIndex(self.space, tuple(take for take in self.takes if take.name != name))

    def example(self, take: str, start: int, end: int) -> Float32[np.ndarray, "samples D"]:
        """Frames [start, end) of a take that is in the index; raises `ParameterError` where they are not there."""
        for one in self.takes:
            if one.name == take:
                return cut_example(one, start, end)
        raise ParameterError("unknown-take", f"There is no take {take!r} to search by.")

    @cached_property
    def unit(self) -> float:
        """What two moments of the takes at random are apart, squared."""
        squares = sum(float(np.einsum("sd,sd->", take.values, take.values)) for take in self.takes)
        return 2 * squares / max(sum(len(take.values) for take in self.takes), 1) or 1.0

    def find(
        self, example: Float32[np.ndarray, "samples D"], most: int = 50, *, threads: int = 1
    ) -> tuple[FoundRange, ...]:
        """The ranges most like an example, the nearest first; none overlaps a nearer one by half or more.

        The same answer for any number of threads. O(steps · samples).
        """
        coarse = max(-(-len(example) // MOST_SAMPLES), 1)
        asked = np.ascontiguousarray(example[::coarse])
        kinds = [asked]
        if self.space.mirrors:
            signs = self.space.signs.astype(np.float32)
            kinds.append(np.ascontiguousarray(asked * np.concatenate([signs, signs])))

        def search(part: Sequence[IndexedTake]) -> list[Candidates]:
            return [_candidates(take, kinds, coarse, most, self.unit) for take in part]

        with single_threaded_blas(), ThreadPoolExecutor(threads) as pool:
            parts = [self.takes[at : at + TAKES_AT_ONCE] for at in range(0, len(self.takes), TAKES_AT_ONCE)]
            found = list(chain.from_iterable(pool.map(search, parts)))
        return _best_ranges(self.takes, found, coarse, most)


def index_take(space: PoseSpace, name: str, poses: BodyPoses) -> IndexedTake:
    """A take as it is searched; raises `InvalidModel` (`not-comparable`) for another body."""
    track = space.track(name, poses)
    speeds = space.speeds(track, poses.rate)
    group = max(round(poses.rate / STEPS_PER_SECOND), 1)
    values = np.concatenate([track, speeds * np.float32(SPEED_WEIGHT)], axis=1)
    starts = np.arange(0, len(values), group)
    means = np.add.reduceat(values, starts, axis=0) / np.diff(np.append(starts, len(values)))[:, None]
    return IndexedTake(name, means.astype(np.float32), poses.frames, poses.stride * group, poses.frame_rate)


def cut_example(take: IndexedTake, start: int, end: int) -> Float32[np.ndarray, "samples D"]:
    """Frames [start, end) of a take as an example; raises `ParameterError` (`outside-take`)."""
    if not 0 <= start < end <= take.frames or end - start < LEAST_SECONDS * take.frame_rate:
        detail = f"Frames {start} to {end} of {take.name!r}, which has {take.frames}, are no range to search by."
        raise ParameterError("outside-take", detail, frame=start)
    first, last = round(start / take.stride), max(round(end / take.stride), round(start / take.stride) + 2)
    return np.ascontiguousarray(take.values[first:last])


Candidates = tuple[Float32[np.ndarray, "_"], Int[np.ndarray, "_ 3"]]
"""Distances, and of each range its first step, the step after its last, and whether it is mirrored."""


def _candidates(
    take: IndexedTake, examples: list[Float32[np.ndarray, "samples D"]], coarse: int, most: int, unit: float
) -> Candidates:
    """The ranges of one take that no range nearby is more like; the best, and enough of them to choose from."""
    values = np.ascontiguousarray(take.values[::coarse])
    distances, places = [], []
    for mirrored, example in enumerate(examples):
        total, begins = np.empty(len(values), np.float32), np.empty(len(values), np.int32)
        warp_onto_ranges(_unlikeness(values, example, unit), BEND, total, begins)
        ends = _minima(total)
        distances.append(total[ends])
        places.append(np.stack([begins[ends], ends + 1, np.full(len(ends), mirrored)], axis=1))
    distance, place = np.concatenate(distances), np.concatenate(places).astype(np.int64)
    order = np.argsort(distance, kind="stable")[: ENOUGH * most]
    return distance[order], place[order]


def _best_ranges(
    takes: tuple[IndexedTake, ...], found: list[Candidates], coarse: int, most: int
) -> tuple[FoundRange, ...]:
    """The nearest of all candidates, without those that overlap a nearer one."""
    if not found:
        return ()
    of_take = np.repeat(np.arange(len(found)), [len(distance) for distance, _ in found])
    distance = np.concatenate([one for one, _ in found])
    place = np.concatenate([one for _, one in found])
    chosen: dict[int, list[tuple[int, int]]] = {}
    ranked: list[FoundRange] = []
    for i in np.argsort(distance, kind="stable").tolist():
        if len(ranked) >= most:
            break
        start, end, mirrored = place[i].tolist()
        number = int(of_take[i])
        others = chosen.setdefault(number, [])
        if any(_overlap((start, end), other) >= MOST_OVERLAP for other in others):
            continue
        others.append((start, end))
        take = takes[number]
        first, last = round(start * take.stride * coarse), min(round(end * take.stride * coarse), take.frames)
        ranked.append(FoundRange(take.name, first, last, float(distance[i]), bool(mirrored)))
    return tuple(ranked)


def _unlikeness(
    values: Float32[np.ndarray, "steps D"], example: Float32[np.ndarray, "samples D"], unit: float
) -> Float32[np.ndarray, "steps samples"]:
    """The squared distance of every step and every sample, in such units."""
    squares = np.einsum("sd,sd->s", values, values)[:, None] + np.einsum("sd,sd->s", example, example)[None, :]
    squares -= 2 * values @ example.T
    return np.asarray(np.maximum(squares, np.float32(0)) / np.float32(unit))


def _minima(total: Float32[np.ndarray, "steps"]) -> Int[np.ndarray, "minima"]:
    """The steps at which the cost is least among their neighbours, and finite."""
    padded = np.concatenate([[np.inf], total, [np.inf]])
    here = padded[1:-1]
    return np.flatnonzero(np.isfinite(here) & (here <= padded[:-2]) & (here < padded[2:]))


def _overlap(one: tuple[int, ...], other: tuple[int, ...]) -> float:
    """Length of what two ranges share, over that of the shorter."""
    shared = min(one[1], other[1]) - max(one[0], other[0])
    return max(shared, 0) / max(min(one[1] - one[0], other[1] - other[0]), 1)
