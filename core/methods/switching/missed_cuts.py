"""Missed cuts: where labellings that were not chosen cut the take, and the chosen one does not."""

from collections.abc import Iterable

import numpy as np
from jaxtyping import Int

from caesura.core.methods.switching.labellings import Labelling

NEAR_SECONDS = 0.5
LEAST = 0.1
MOST_MORE = 2
"""Labellings of up to two motions more are asked: they tell which segment would be two."""


def find_missed_cuts(
    chosen: Labelling, others: Iterable[Labelling], frame_rate: float
) -> tuple[tuple[int, float], ...]:
    """Frames, and how likely a cut is missing there, 0 to 1, the likeliest first.

    Each labelling votes for its cuts that are more than half a second from those of the chosen one. A vote weighs
    exp(−excess / worth), the excess being how much more the labelling is cut than the chosen one, beyond what its
    motions are worth. Votes within half a second are for the same cut, which is their median.
    """
    near = round(NEAR_SECONDS * frame_rate)
    known = np.concatenate([[0], _cuts(chosen.labels), [len(chosen.labels)]])
    at, weight, whole = [], [], 0.0
    for other in others:
        if chosen.motions <= other.motions <= chosen.motions + MOST_MORE:
            excess = other.cut - chosen.cut - other.worth * (other.motions - chosen.motions)
            vote = float(np.exp(-max(excess, 0.0) / other.worth))
            whole += vote
            for cut in _cuts(other.labels).tolist():
                if np.abs(known - cut).min() > near:
                    at.append(cut)
                    weight.append(vote)
    order = np.argsort(at, kind="stable")
    frames, votes = np.array(at, np.int64)[order], np.array(weight)[order]
    groups = np.split(np.arange(len(frames)), np.flatnonzero(np.diff(frames) > near) + 1) if len(frames) else []
    found = [(int(np.median(frames[group])), min(float(votes[group].sum()) / whole, 1.0)) for group in groups]
    return tuple(sorted(((f, p) for f, p in found if p >= LEAST), key=lambda pair: (-pair[1], pair[0])))


def _cuts(labels: Int[np.ndarray, "frames"]) -> Int[np.ndarray, "cuts"]:
    return np.flatnonzero(np.diff(labels)) + 1
