"""Key-frames of least reconstruction error by a genetic algorithm (Lee, Lin, Wang and Chen 2008, the paper's [12]).

An individual is a set of key-frames, the first and the last frame among them. Of two parents a child has those that
both have, and of the others as many as it needs; one of its key-frames may move. The best are always kept, and climb to
the nearest optimum at the end. Its draws are of a generator of its own, so that the same seed gives the same key-frames
on any thread; the libraries that offer such algorithms draw from one generator for the whole process.
"""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.reconstruction.key_frame_motions import cut_by_key_frames
from caesura.core.methods.reconstruction.reconstruction_error import ReconstructionError
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 20_000
INDIVIDUALS = 48
GENERATIONS = 80
BEST = 4
MUTATED = 0.6
CLIMBS = 20


def genetic(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take between its key-frames of least reconstruction error, whose poses are put into K motions."""
    return cut_by_key_frames(analysis, parameters, breed_key_frames, MOST_FRAMES)


def breed_key_frames(values: Float[np.ndarray, "frames D"], count: int, seed: int) -> Int[np.ndarray, "keys"]:
    """`count` key-frames in order, of which the take is made again with as little error as could be bred.

    O(frames + generations · individuals · count).
    """
    error = ReconstructionError.of(values)
    inner = count - 2
    if inner < 1 or len(values) <= count:
        return np.unique(np.linspace(0, len(values) - 1, count).astype(np.int64))
    random = np.random.default_rng(seed)
    last = len(values) - 1
    even = np.linspace(0, last, count).round().astype(np.int64)
    herd = np.stack(
        [even, *(_keys(random.choice(last - 1, inner, replace=False) + 1, last) for _ in range(INDIVIDUALS - 1))]
    )
    for _ in range(GENERATIONS):
        herd = herd[np.argsort(error.of_keys(herd), kind="stable")]
        parents = np.minimum(*random.integers(INDIVIDUALS, size=(2, INDIVIDUALS - BEST, 2)))  # the better of two
        children = [_child(herd[one], herd[other], last, random) for one, other in parents.tolist()]
        herd = np.concatenate([herd[:BEST], np.stack(children)])
    best = herd[np.argsort(error.of_keys(herd), kind="stable")[:BEST]]
    climbed = [_climb(keys, error) for keys in best]
    return min(climbed, key=lambda keys: float(error.of_keys(keys)))


def _keys(inner: Int[np.ndarray, "inner"], last: int) -> Int[np.ndarray, "keys"]:
    return np.concatenate([[0], np.sort(inner), [last]]).astype(np.int64)


def _child(
    one: Int[np.ndarray, "keys"], other: Int[np.ndarray, "keys"], last: int, random: np.random.Generator
) -> Int[np.ndarray, "keys"]:
    """What both have, and as many of the rest as are missing; in most cases with one key-frame moved elsewhere."""
    first, second = one[1:-1], other[1:-1]
    shared = np.intersect1d(first, second, assume_unique=True)
    rest = np.setxor1d(first, second, assume_unique=True)
    inner = np.concatenate([shared, random.permutation(rest)[: len(first) - len(shared)]])
    if random.random() < MUTATED:
        place, frame = int(random.integers(len(inner))), int(random.integers(1, last))
        if frame not in inner:
            inner[place] = frame
    return _keys(inner, last)


def _climb(keys: Int[np.ndarray, "keys"], error: ReconstructionError) -> Int[np.ndarray, "keys"]:
    """Every inner key-frame moved to the best place between its neighbours, again and again until none moves."""
    keys = keys.copy()
    for _ in range(CLIMBS):
        before = keys.copy()
        for place in range(1, len(keys) - 1):
            frames = np.arange(keys[place - 1] + 1, keys[place + 1])
            start, stop = np.full(len(frames), keys[place - 1]), np.full(len(frames), keys[place + 1])
            keys[place] = frames[np.argmin(error.between(start, frames) + error.between(frames, stop))]
        if np.array_equal(keys, before):
            break
    return keys
