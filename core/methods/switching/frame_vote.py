"""The vote on frames: where labellings of the same motions put a cut otherwise, the frames beside it go with most."""

from collections.abc import Iterable

import numpy as np
from jaxtyping import Int


def vote_on_frames(
    labels: Int[np.ndarray, "frames"], others: Iterable[Int[np.ndarray, "frames"]]
) -> Int[np.ndarray, "frames"]:
    """For every frame the motion that most of the others give it; among equals that of `labels`.

    A motion of another labelling is the one of `labels` with which it shares most frames. The segments stay which they
    are: where the vote would make one more or one less, `labels` come back.
    """
    names, own = np.unique(labels, return_inverse=True)
    frames = np.arange(len(labels))
    votes = np.zeros((len(labels), len(names)), np.int16)
    votes[frames, own] = 1
    for other in others:
        shared = np.zeros((int(other.max()) + 1, len(names)), np.int64)
        np.add.at(shared, (other, own), 1)
        votes[frames, shared.argmax(axis=1)[other]] += 2
    voted = np.asarray(names[votes.argmax(axis=1)])
    return voted if np.array_equal(_motions_in_order(voted), _motions_in_order(labels)) else labels


def _motions_in_order(labels: Int[np.ndarray, "frames"]) -> Int[np.ndarray, "segments"]:
    """The motion of every segment."""
    return np.asarray(labels[np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1])])
