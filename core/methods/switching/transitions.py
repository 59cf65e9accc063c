"""Transitions: what lasts hardly a second in all its runs is no motion, but the way from one to the next."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

SHORTEST_SECONDS = 1.2


@dataclass(frozen=True)
class LabelsAndTransitions:
    """Labels with the transitions given to their neighbours, and where they were: [start, end) of each."""

    labels: Int[np.ndarray, "frames"]
    transitions: tuple[tuple[int, int], ...]


def remove_transitions(labels: Int[np.ndarray, "frames"], frame_rate: float) -> LabelsAndTransitions:
    """Motions whose longest run is below 1.2 s, the shortest first, divided in the middle between the neighbours.

    At the ends of a take a transition goes to the one neighbour it has. The last motion stays.
    """
    labels = labels.copy()
    found: list[tuple[int, int]] = []
    while True:
        bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
        lengths, motions = np.diff(bounds), labels[bounds[:-1]]
        longest = np.zeros(int(labels.max()) + 1, np.int64)
        np.maximum.at(longest, motions, lengths)
        present = np.flatnonzero(longest)
        shortest = present[longest[present].argmin()]
        if longest[shortest] >= SHORTEST_SECONDS * frame_rate or len(present) < 2:
            return LabelsAndTransitions(labels, tuple(sorted(found)))
        for i in np.flatnonzero(motions == shortest).tolist():
            start, end = int(bounds[i]), int(bounds[i + 1])
            found.append((start, end))
            middle = start if i == 0 else end if end == len(labels) else (start + end) // 2
            labels[start:middle] = labels[start - 1] if i else 0
            labels[middle:end] = labels[end] if end < len(labels) else 0
