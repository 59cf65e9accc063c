"""Blur: while a window passes over a cut it holds two motions, and may look like a third."""

from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.methods.switching.switching_k_means import SwitchingClusters, squared_distances
from caesura.core.methods.switching.windowed_signal import WINDOW_SECONDS, WindowedSignal


def remove_short_segments(signal: WindowedSignal, settled: SwitchingClusters) -> SwitchingClusters:
    """The same with segments shorter than a window given to their neighbours, shortest first.

    Such a segment is divided where the distances to the two motions beside it are least. The first and the last
    segment stay, and so does the only segment of a motion: that motion was asked for, or found to be real.
    """
    labels = settled.labels.copy()
    squares = np.einsum("sd,sd->s", signal.values, signal.values)
    cost = squared_distances(signal.values, squares, settled.means)
    while (found := _shortest_segment(labels, signal.steps(WINDOW_SECONDS))) is not None:
        start, stop = found
        before, after = labels[start - 1], labels[stop]
        divide = start + _divide_between_neighbours(cost[start:stop, before], cost[start:stop, after])
        labels[start:divide], labels[divide:stop] = before, after
    return replace(settled, labels=labels)


def _shortest_segment(labels: Int[np.ndarray, "steps"], enough: int) -> tuple[int, int] | None:
    """The shortest inner segment that is too short and not the only one of its motion, the first of equals."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    lengths, motions = np.diff(bounds), labels[bounds[:-1]]
    lengths[np.bincount(motions)[motions] == 1] = enough
    lengths[[0, -1]] = enough
    shortest = int(lengths.argmin())
    return (int(bounds[shortest]), int(bounds[shortest + 1])) if lengths[shortest] < enough else None


def _divide_between_neighbours(before: Float[np.ndarray, "steps"], after: Float[np.ndarray, "steps"]) -> int:
    """How many steps go to the motion before, so that the distances are least."""
    return int(np.concatenate([[0.0], np.cumsum(before - after)]).argmin())
