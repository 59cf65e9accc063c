"""The energy curve of a take (paper, sections 3.1 and 3.2): how much the pose of the body varies about each frame."""

from collections.abc import Iterable
from typing import Literal

import numpy as np
from jaxtyping import Float

from caesura.core.energy.joint_entropy import (
    Bins,
    FramePairing,
    compute_joint_entropy,
    compute_sliding_sums,
    plan_frame_pairings,
)
from caesura.core.frames.blocks import map_blocks


def frames_per_window(
    energy: Literal["modified", "joint", "distance"], window_seconds: float, frame_rate: float
) -> int:
    """l, the length of a window in frames: 1 for neighbours (`joint`), for Eq. 1 is Eq. 3 with windows of one frame.

    Plain distances (`distance`) are of neighbours too.
    """
    return max(round(window_seconds * frame_rate), 1) if energy == "modified" else 1


def compute_energy_curve(
    bins: Iterable[Bins], frames: int, length: int, levels: int, threads: int = 1
) -> Float[np.ndarray, "frames"]:
    """H of the windows m−l+1 … m and m+1 … m+l (Eq. 3) at every frame m, in nats.

    `bins`, of so many `levels`, come in blocks of frames. Defined for l−1 ≤ m ≤ frames−l−1; NaN elsewhere.
    O(frames · columns) whatever l is.
    """
    energy = np.full(frames, np.nan)
    if frames < 2 * length:
        return energy
    counted = map_blocks(FramePairing.counts, plan_frame_pairings(bins, length, levels), threads)
    m = length - 1
    for sums in compute_sliding_sums(counted, length):
        energy[m : m + len(sums)] = compute_joint_entropy(sums)
        m += len(sums)
    return energy
