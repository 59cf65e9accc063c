"""Aligned cluster analysis in two levels: frames into moves, moves into motions."""

import numpy as np
from jaxtyping import Float

from caesura.core.methods.alignment.cluster_analysis import AlignedClusters, cluster_by_alignment
from caesura.core.methods.alignment.dynamic_time_alignment import dynamic_time_alignment_kernel
from caesura.core.methods.alignment.initial_segmentation import InitialSegmenter
from caesura.core.methods.alignment.segments import SegmentLengths, Segments

MOVES = 12
"""Kinds of moves at the first level."""
STARTS = 5
STARTS_ABOVE = 10
SEEDS = 16
"""So many seeds of starts belong to one seed."""


def cluster_in_two_levels(
    kernel: Float[np.ndarray, "samples samples"],
    motions: int,
    moves: SegmentLengths,
    above: SegmentLengths,
    seed: int,
    *,
    as_measured: bool = False,
) -> Segments:
    """HACA: the cheapest of 5 runs of both levels.

    `moves` are the lengths of moves in samples, `above` those of motions in moves. Cuts lie where moves begin.
    """
    first = InitialSegmenter.of(kernel, np.ones(len(kernel)), MOVES, moves, as_measured=as_measured)
    runs = [_run(first, first.start(_seed(seed, start)), motions, above, seed) for start in range(STARTS)]
    return min(runs, key=lambda run: run.cost).segments


def _run(first: InitialSegmenter, start: Segments, motions: int, above: SegmentLengths, seed: int) -> AlignedClusters:
    """Both levels once; the second from the cheapest of 10 initial segmentations, each move weighing its length."""
    moves = cluster_by_alignment(first.kernel, first.weights, start, first.lengths.longest).segments
    alike = dynamic_time_alignment_kernel(first.kernel, first.weights, moves.bounds)
    weights = moves.lengths.astype(np.float64)
    second = InitialSegmenter.of(alike, weights, motions, above, as_measured=first.as_measured)
    starts = [second.start(_seed(seed, start)) for start in range(STARTS_ABOVE)]
    best = min(
        (cluster_by_alignment(alike, weights, start, second.lengths.longest) for start in starts),
        key=lambda run: run.cost,
    )
    return AlignedClusters(Segments(moves.bounds[best.segments.bounds], best.segments.labels), best.cost)


def _seed(seed: int, start: int) -> int:
    return (SEEDS * seed + start) % 2**32
