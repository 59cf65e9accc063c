"""Runs of equal labels that are too short to be motions, given to their neighbours."""

import numpy as np
from jaxtyping import Int


def remove_short_runs(labels: Int[np.ndarray, "samples"], shortest: int) -> Int[np.ndarray, "samples"]:
    """No run is shorter than `shortest`, but one that is all there is.

    The shortest run (the first of equals) goes first: at an end, to the one beside it; in the middle, half to either
    side. That again and again.
    """
    labels = labels.copy()
    while True:
        bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
        lengths = np.diff(bounds)
        run = int(lengths.argmin())
        if len(lengths) == 1 or lengths[run] >= shortest:
            return labels
        start, stop = int(bounds[run]), int(bounds[run + 1])
        middle = (start + stop + 1) // 2
        if run == 0:
            middle = start
        elif run == len(lengths) - 1:
            middle = stop
        labels[start:middle] = labels[start - 1]
        labels[middle:stop] = labels[min(stop, len(labels) - 1)]
