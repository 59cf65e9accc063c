"""Welding: which vertices of a file are one point of the surface.

Files repeat a vertex wherever its normal or its texture breaks, down to three of its own for every triangle. A
surface in such pieces has no neighbours, no geodesics and no curvature until the copies are one point again.
"""

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.animation import Animation
from caesura.core.block_pass.projection import choose_sample_frames
from caesura.core.descriptors.strain import ROUNDING
from caesura.core.frames.sampled_frames import read_sampled_frames

SAMPLED_FRAMES = 8
"""Frames looked at to see whether copies move together."""


def weld_vertices(animation: Animation, rest: Float32[np.ndarray, "V 3"]) -> Int[np.ndarray, "V"]:
    """For every vertex the lowest one that is the same point: at the same place at rest and in a few frames.

    Places at rest are compared exactly, as copies are written; those in 8 evenly spaced frames to within rounding.
    Parts that touch at rest and move apart in one of those frames stay apart. O(V log V).
    """
    looks = read_sampled_frames(animation, choose_sample_frames(animation.frames, SAMPLED_FRAMES))
    return find_same_points(rest, looks)


def find_same_points(
    rest: Float32[np.ndarray, "V 3"], looks: Float32[np.ndarray, "frames V 3"]
) -> Int[np.ndarray, "V"]:
    """The same, of frames that are at hand."""
    tolerance = np.float32(ROUNDING * np.abs(looks).max(initial=0))
    _, place = np.unique(rest + np.float32(0), axis=0, return_inverse=True)  # + 0: −0 and 0 are one place
    place, same = place.reshape(-1), np.arange(len(rest))
    left = same
    while len(left):  # each round, the lowest vertex of every place takes those that move with it
        _, first, group = np.unique(place[left], return_index=True, return_inverse=True)
        leader = left[first][group]
        together = (np.abs(looks[:, left] - looks[:, leader]) <= tolerance).all(axis=(0, 2))
        same[left[together]] = leader[together]
        left = left[~together]
    return same
