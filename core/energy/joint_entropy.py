"""Joint entropy of the strains at two times (paper, Eq. 1 to 3), from counts of triangles.

For the frame pair (n, n + l) let C_n be the B x B matrix that counts the triangles in bin i at n and bin j at
n + l. Every probability of the paper is a sum of such counts over a fixed total, so counts are all that is kept:
integers, the same in any order and on any number of threads.
"""

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, Int32, UInt8

from caesura.core.kernels import counting

Bins = UInt8[np.ndarray, "_ columns"]
"""The bin of each triangle's strain in the frames of a block."""


@dataclass(frozen=True)
class FramePairing:
    """The bins of some frames, and those of the frames l later, in the pieces at hand; of so many levels."""

    pieces: tuple[tuple[Bins, Bins], ...]
    levels: int

    def counts(self) -> Int32[np.ndarray, "pairs levels2"]:
        """C_n of every pair in turn, each row a matrix of levels x levels (Eq. 1, times the number of triangles)."""
        counted = []
        for frames, later in self.pieces:
            counts = np.empty((len(frames), self.levels**2), np.int32)
            counting.count_pairs(frames, later, self.levels, counts)
            counted.append(counts)
        return np.concatenate(counted)


def plan_frame_pairings(blocks: Iterable[Bins], lag: int, levels: int) -> Iterator[FramePairing]:
    """Join every frame with the one `lag` frames later, as the blocks come; holds the last `lag` frames."""
    held: deque[np.ndarray] = deque()
    behind = 0  # frames that were read and have not met their partner
    for block in blocks:
        held.append(block)
        behind += len(block)
        pieces = []
        while behind > lag:
            first = held.popleft()
            at = len(block) - (behind - lag)
            width = min(len(first), behind - lag)
            pieces.append((first[:width], block[at : at + width]))
            behind -= width
            if width < len(first):
                held.appendleft(first[width:])
        if pieces:
            yield FramePairing(tuple(pieces), levels)


def compute_sliding_sums(
    counts: Iterable[Int[np.ndarray, "_ levels2"]], length: int
) -> Iterator[Int[np.ndarray, "_ levels2"]]:
    """C_{m−l+1} + … + C_m for every m ≥ l − 1, in as many pieces as come; O(1) a frame whatever the length."""
    before: np.ndarray | None = None
    for piece in counts:
        recent = piece if before is None else np.concatenate([before, piece])
        sums = np.empty((max(len(recent) - length + 1, 0), recent.shape[1]), np.int64)
        counting.slide_window(recent, length, sums)
        before = recent[max(len(recent) - length + 1, 0) :]
        if len(sums):
            yield sums


def compute_joint_entropy(counts: Int[np.ndarray, "frames levels2"]) -> Float[np.ndarray, "frames"]:
    """H = −Σ P ln P with P = counts / Σ counts (Eq. 2), in nats: 0 to ln B². Nothing counted: 0."""
    entropy = np.empty(len(counts))
    counting.entropy_of_counts(np.ascontiguousarray(counts, np.int64), entropy)
    return entropy
