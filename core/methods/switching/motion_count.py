"""Choice: how many motions a take has, when nobody says."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from caesura.core.methods.switching.initial_segments import InitialSegments
from caesura.core.methods.switching.separation import measure_separations
from caesura.core.methods.switching.switching_k_means import SwitchingClusters, run_switching_k_means
from caesura.core.methods.switching.windowed_signal import WINDOW_SECONDS, WindowedSignal

SHORTEST_SECONDS = 1.5 * WINDOW_SECONDS
"""A motion that never lasts so long is a transition: the window and a cross-fade of half of it blur that much."""
PATIENCE = 6
"""So many more motions are tried without finding one that is real, …"""
FLAT = 0.9
"""… and for as long as they still take a tenth off the cost: among thirty motions, two groups of them look alike."""
MOST = 200


@dataclass(frozen=True)
class MotionCountChoice:
    """The solution for the chosen number of motions, and the cost left for every number that was tried."""

    settled: SwitchingClusters
    scores: tuple[tuple[int, float], ...]


def choose_motion_count(signal: WindowedSignal, stretches: InitialSegments, penalty: float) -> MotionCountChoice:
    """Try 1, 2, 3, … motions, and take as many as were found to be real.

    Every motion saves less than the one before it where there are thirty, so a share of the cost cannot decide:
    at each K the motions are counted that last and lie apart. The count grows with K up to the true number and then
    stays, because what comes next are halves and transitions. The scores are costs, as shares of that of one motion.
    """
    tried: list[SwitchingClusters] = []
    real = met = 1
    for count in range(1, min(len(stretches), MOST) + 1):
        tried.append(run_switching_k_means(signal.values, stretches.grouped(count), penalty))
        found = count_separate_motions(signal, tried[-1])
        if found > real:
            real, met = found, count
        flat = count > PATIENCE and tried[-1].cost > FLAT * tried[-1 - PATIENCE].cost
        if flat and count >= met + PATIENCE:
            break
    whole = tried[0].cost or 1.0
    scores = tuple((i + 1, settled.cost / whole) for i, settled in enumerate(tried))
    return MotionCountChoice(tried[min(real, len(tried)) - 1], scores)


def count_separate_motions(signal: WindowedSignal, settled: SwitchingClusters) -> int:
    """How many motions last and lie apart: those that do not are counted with their nearest."""
    if settled.motions == 1:
        return 1
    lasting = _longest_runs(settled.labels, settled.motions) >= signal.steps(SHORTEST_SECONDS)
    apart = measure_separations(signal, settled.labels, settled.motions)
    return max(_groups(apart[np.ix_(lasting, lasting)] < 1), 1)


def _longest_runs(labels: Int[np.ndarray, "steps"], count: int) -> Int[np.ndarray, "K"]:
    """The length of the longest segment of every motion."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    longest = np.zeros(count, np.int64)
    np.maximum.at(longest, labels[bounds[:-1]], np.diff(bounds))
    return longest


def _groups(near: Bool[np.ndarray, "n n"]) -> int:
    """How many groups are there when near ones belong together, and the near ones of those?"""
    group = np.arange(len(near))
    for a, b in np.argwhere(near).tolist():
        if a < b:
            group[group == group[b]] = group[a]
    return len(np.unique(group))
