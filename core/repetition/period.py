"""How long a repetition takes: the first time after which a passage looks like itself.

The difference function of YIN, which finds the pitch of a voice in the same way (de Cheveigné and Kawahara, 2002),
taken over all directions of the passage together.
"""

import numpy as np
from jaxtyping import Float

SHORTEST_SECONDS = 0.3
LONGEST_SHARE = 0.65
"""Of the passage: twice is the least that is a repetition, and the two may take 3 : 2."""
LARGEST_DIFFERENCE = 0.85
"""A passage nowhere more like itself than this repeats nothing; 1 is as unlike as at all shorter times."""
PERIOD_SLACK = 0.35
"""The first dip within this of the deepest counts: two walks of two steps are alike too, but one step is the step."""


def find_period(passage: Float[np.ndarray, "frames d"], frame_rate: float) -> int:
    """Frames of a repetition; 0 where nothing repeats. O(frames log frames)."""
    longest = int(len(passage) * LONGEST_SHARE)
    shortest = max(round(SHORTEST_SECONDS * frame_rate), 1)
    if passage.shape[1] == 0 or longest < shortest + 2:
        return 0
    unlike = difference_function(passage, longest)
    inner = np.arange(shortest, longest)
    dips = inner[(unlike[inner] < unlike[inner - 1]) & (unlike[inner] <= unlike[inner + 1])]
    if len(dips) == 0 or (deepest := unlike[dips].min()) > LARGEST_DIFFERENCE:
        return 0
    return int(dips[unlike[dips] <= deepest + PERIOD_SLACK][0])


def difference_function(passage: Float[np.ndarray, "frames d"], longest: int) -> Float[np.ndarray, "lags"]:
    """For lags 0 … `longest`: the mean square difference of frames a lag apart, over its mean at lags 1 … lag."""
    frames = len(passage)
    spectrum = np.fft.rfft(passage, 2 * frames, axis=0)
    power = np.einsum("fd,fd->f", spectrum.real, spectrum.real) + np.einsum("fd,fd->f", spectrum.imag, spectrum.imag)
    alike = np.fft.irfft(power, 2 * frames)[: longest + 1]
    total = np.concatenate([[0.0], np.cumsum(np.einsum("fd,fd->f", passage, passage))])
    lags = np.arange(longest + 1)
    difference = np.maximum(total[frames - lags] + total[-1] - total[lags] - 2 * alike, 0.0) / (frames - lags)
    mean = np.cumsum(difference)[1:] / lags[1:]
    return np.concatenate([[1.0], difference[1:] / np.maximum(mean, np.finfo(np.float64).tiny)])
