"""Segments of a row of samples, and how long they may be."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int


@dataclass(frozen=True)
class SegmentLengths:
    """The fewest and the most samples of a segment."""

    shortest: int
    longest: int

    def within(self, samples: int) -> "SegmentLengths":
        """As near to these as lets segments tile so many samples: 61 are no sum of numbers from 32 to 60."""
        longest = min(self.longest, samples)
        fewest = -(-samples // longest)
        return SegmentLengths(min(self.shortest, samples // fewest), longest)


@dataclass(frozen=True)
class Segments:
    """Segment i is samples bounds[i] … bounds[i+1]−1, of group labels[i]."""

    bounds: Int[np.ndarray, "bounds"]
    labels: Int[np.ndarray, "segments"]

    @classmethod
    def traced(cls, head: Int[np.ndarray, "samples"], group: Int[np.ndarray, "samples"]) -> "Segments":
        """From where the last segment of every beginning of the row begins, and its group."""
        bounds, labels = [len(head)], []
        while bounds[-1] > 0:
            labels.append(int(group[bounds[-1] - 1]))
            bounds.append(int(head[bounds[-1] - 1]))
        return cls(np.array(bounds[::-1]), np.array(labels[::-1]))

    @property
    def lengths(self) -> Int[np.ndarray, "segments"]:
        """Samples of every segment."""
        return np.diff(self.bounds)

    @property
    def per_sample(self) -> Int[np.ndarray, "samples"]:
        """The group of every sample."""
        return np.asarray(np.repeat(self.labels, self.lengths))

    def same(self, other: "Segments") -> bool:
        """The same cuts and the same groups?"""
        return np.array_equal(self.bounds, other.bounds) and np.array_equal(self.labels, other.labels)
