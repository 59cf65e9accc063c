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

Bins = UInt8[np.ndarray, "columns _"]
"""The bin of each triangle's strain in the frames of a block."""


@dataclass(frozen=True)
class FramePairing:
    """The bins of some frames, and those of the frames l later, in the pieces at hand; of so many levels.

    A piece is the block of the one and its first frame, that of the others and theirs, and how many frames it has.
    """

    pieces: tuple[tuple[Bins, int, Bins, int, int], ...]
    levels: int

    def counts(self) -> Int32[np.ndarray, "pairs levels2"]:
        """C_n of every pair in turn, each row a matrix of levels x levels (Eq. 1, times the number of triangles)."""
        counted = []
        for first, start, second, later, frames in self.pieces:
            counts = np.empty((frames, self.levels**2), np.int32)
            counting.count_pairs(first, start, second, later, self.levels, counts)
            counted.append(counts)
        return np.concatenate(counted)


def plan_frame_pairings(blocks: Iterable[Bins], lag: int, levels: int) -> Iterator[FramePairing]:
    """Join every frame with the one `lag` frames later, as the blocks come; holds the last `lag` frames."""
    held: deque[tuple[np.ndarray, int]] = deque()
    behind = 0  # frames that were read and have not met their partner
    for block in blocks:
        held.append((block, 0))
        behind += block.shape[1]
        pieces = []
        while behind > lag:
            first, start = held.popleft()
            width = min(first.shape[1] - start, behind - lag)
            pieces.append((first, start, block, block.shape[1] - (behind - lag), width))
            behind -= width
            if start + width < first.shape[1]:
                held.appendleft((first, start + width))
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
