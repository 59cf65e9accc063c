"""Aligned cluster analysis: kernel k-means over segments whose cuts are found with them."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.core.kernels import alignment
from caesura.core.methods.alignment.dynamic_time_alignment import dynamic_time_alignment_kernel
from caesura.core.methods.alignment.segments import Segments

PASSES = 20


@dataclass(frozen=True)
class AlignedClusters:
    """Segments, and what they cost against the groups they were cut for."""

    segments: Segments
    cost: float


def cluster_by_alignment(
    kernel: Float[np.ndarray, "samples samples"],
    weights: Float[np.ndarray, "samples"],
    start: Segments,
    longest: int,
) -> AlignedClusters:
    """Cut the samples anew against the groups of segments, again and again, until nothing changes.

    Each pass finds, exactly, the segments of at most `longest` samples of least Σ ‖ψ(segment) − mean of its group‖²,
    the groups being those of the pass before. That is not monotone: where it has not settled after 20 passes, the
    20th stands. A segment counts as one whatever its length, so few and long ones are cheap: `longest` holds them.
    A group that gets no segment is gone; the cost is infinite then, and the pass before stands. O(samples² longest).
    """
    now = AlignedClusters(start, np.inf)
    for _ in range(PASSES):
        following = _recut(kernel, weights, now.segments, longest)
        if len(np.unique(following.segments.labels)) < len(np.unique(now.segments.labels)):
            return AlignedClusters(now.segments, np.inf)
        if following.segments.same(now.segments):
            return following
        now = following
    return now


def _recut(
    kernel: Float[np.ndarray, "samples samples"], weights: Float[np.ndarray, "samples"], given: Segments, longest: int
) -> AlignedClusters:
    """One pass."""
    alike = dynamic_time_alignment_kernel(kernel, weights, given.bounds)
    member = (given.labels == np.arange(given.labels.max() + 1)[:, None]).astype(np.float64)
    spread = np.einsum("ci,ij,cj->c", member, alike, member, optimize=True) / member.sum(axis=1) ** 2
    head, group = np.empty(len(kernel), np.int64), np.empty(len(kernel), np.int64)
    cost = alignment.cut_anew(kernel, weights, given.bounds, given.labels, spread, longest, head, group)
    return AlignedClusters(Segments.traced(head, group), cost)
