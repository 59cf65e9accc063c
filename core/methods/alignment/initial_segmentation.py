"""The first segmentation: groups of samples by likeness that persists, then segments that are mostly of one group."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import alignment
from caesura.core.methods.alignment.dynamic_time_alignment import dynamic_time_alignment_kernel
from caesura.core.methods.alignment.segments import SegmentLengths, Segments
from caesura.core.methods.alignment.spectral_clustering import cluster_rows, cluster_spectrally, spectral_embedding

DRAWS = 50


@dataclass(frozen=True)
class InitialSegmenter:
    """What all first segmentations of the same samples have in common; `start` makes one."""

    kernel: Float[np.ndarray, "samples samples"]
    weights: Float[np.ndarray, "samples"]
    groups: int
    lengths: SegmentLengths
    rows: Float[np.ndarray, "samples d"]
    as_measured: bool

    @classmethod
    def of(
        cls,
        kernel: Float[np.ndarray, "samples samples"],
        weights: Float[np.ndarray, "samples"],
        groups: int,
        lengths: SegmentLengths,
        *,
        as_measured: bool = False,
    ) -> "InitialSegmenter":
        """Embeds the samples by propagated likeness. `as_measured`: lengths as the authors' program takes them."""
        lengths = lengths.within(len(kernel))
        propagated = np.zeros_like(kernel)
        alignment.persistent_similarity(kernel, lengths.longest, propagated)
        return cls(kernel, weights, groups, lengths, spectral_embedding(propagated, groups), as_measured)

    def start(self, seed: int) -> Segments:
        """Segments of allowed lengths with as few samples as can be that are not of their segment's commonest group.

        Where a group gets no segment, segments of random lengths are drawn instead and grouped by their own kernel,
        until every group has one or 50 draws were made: then the grouping with the most groups stands.
        """
        groups = cluster_rows(self.rows, self.groups, seed)
        fullest = segments_of_grouped_samples(groups, self.lengths, self.as_measured)
        wanted = min(int(groups.max()) + 1, len(fullest.labels))
        random = np.random.default_rng(seed)
        for _ in range(DRAWS):
            if _count_groups(fullest) >= wanted:
                break
            bounds = _draw_at_random(len(self.kernel), self.lengths, random)
            alike = dynamic_time_alignment_kernel(self.kernel, self.weights, bounds)
            drawn = Segments(bounds, cluster_spectrally(alike, self.groups, seed))
            if _count_groups(drawn) > _count_groups(fullest):
                fullest = drawn
        return Segments(fullest.bounds, np.unique(fullest.labels, return_inverse=True)[1])


def segments_of_grouped_samples(
    groups: Int[np.ndarray, "samples"], lengths: SegmentLengths, as_measured: bool = False
) -> Segments:
    """Segments of samples that were grouped one by one; each is of its most frequent group, the first of equals."""
    head = np.empty(len(groups), np.int64)
    count = int(groups.max()) + 1
    alignment.pure_segments(groups, count, lengths.shortest, lengths.longest, as_measured, head)
    cut = Segments.traced(head, groups)
    pieces = [groups[a:b] for a, b in zip(cut.bounds[:-1], cut.bounds[1:], strict=True)]
    return Segments(cut.bounds, np.array([np.bincount(piece, minlength=count).argmax() for piece in pieces]))


def _count_groups(segments: Segments) -> int:
    return len(np.unique(segments.labels))


def _draw_at_random(samples: int, lengths: SegmentLengths, random: np.random.Generator) -> Int[np.ndarray, "bounds"]:
    """Bounds of segments of uniformly random lengths that tile the samples."""
    bounds = [0]
    while bounds[-1] < samples:
        left = samples - bounds[-1]
        # Only lengths that leave a rest which can be tiled: `within` of the rest is the rest's own lengths then.
        possible = [
            n for n in range(lengths.shortest, min(lengths.longest, left) + 1)
            if n == left or lengths.within(left - n).shortest == lengths.shortest
        ]  # fmt: skip
        bounds.append(bounds[-1] + int(random.choice(possible)))
    return np.array(bounds)
