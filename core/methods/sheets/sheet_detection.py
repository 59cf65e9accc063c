"""Recognition: whether a take is a sheet of clips or a performance.

A performance never returns quite to the pose it left, or it repeats what it does. The clips of a sheet close on
themselves, and each is there once.
"""

import numpy as np
from jaxtyping import Float

from caesura.core.methods.sheets.clip_division import Division, Timeline

CLOSED = 0.015
"""Distance of a closing pose from the first, in distances of a thirtieth of a second at the usual speed. Clips drawn by
artists lie below .005 in the median, takes joined from clips above .04, performances above 2."""
TWIN = 0.5
"""Two clips are twins where they lie so near, pose for pose, against how far each strays from its mean pose."""
MOST_TWINS = 0.3
PLACES = 32


def is_clip_sheet(timeline: Timeline, division: Division) -> bool:
    """Whether most clips close on themselves, and few are there twice."""
    if len(division.starts) < 2:
        return False
    return float(np.median(division.openness)) <= CLOSED and share_of_twin_clips(timeline, division) <= MOST_TWINS


def share_of_twin_clips(timeline: Timeline, division: Division) -> float:
    """The share of the clips that are much like another, whatever their speed."""
    clips = np.stack([
        _resampled(timeline.poses[start // timeline.stride : -(-end // timeline.stride)])
        for start, end in zip(division.starts.tolist(), division.ends.tolist(), strict=True)
    ])  # fmt: skip
    flat = clips.reshape(len(clips), -1)
    squares = np.einsum("cx,cx->c", flat, flat)
    apart = np.maximum(squares[:, None] + squares - 2 * flat @ flat.T, 0.0)
    np.fill_diagonal(apart, np.inf)
    strays = np.square(clips - clips.mean(axis=1, keepdims=True)).sum(axis=(1, 2))
    return float(np.mean(apart.min(axis=1) < TWIN**2 * strays))


def _resampled(poses: Float[np.ndarray, "samples d"]) -> Float[np.ndarray, "places d"]:
    """So many poses, evenly spaced."""
    at = np.linspace(0, len(poses) - 1, PLACES)
    below = np.minimum(at.astype(np.int64), max(len(poses) - 2, 0))
    share = (at - below)[:, None]
    return np.asarray(poses[below] * (1 - share) + poses[np.minimum(below + 1, len(poses) - 1)] * share)
