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

from core import kernels


@dataclass(frozen=True)
class Piece:
    """`width` frames of one block from `at` on, and as many of a later one from `later_at` on.

    The blocks are kept whole, for the rows of a view would not be known to lie in one piece when compiled.
    """

    block: UInt8[np.ndarray, "columns _"]
    at: int
    later: UInt8[np.ndarray, "columns _"]
    later_at: int
    width: int


@dataclass(frozen=True)
class Pairing:
    """The bins of some frames and of those l frames later, in the blocks at hand."""

    pieces: tuple[Piece, ...]
    levels: int

    def counts(self) -> Int32[np.ndarray, "pairs levels2"]:
        """C_n of every pair in turn, each row a matrix of levels x levels (Eq. 1, times the number of triangles)."""
        counted = [np.zeros((piece.width, self.levels**2), np.int32) for piece in self.pieces]
        for piece, counts in zip(self.pieces, counted, strict=True):
            kernels.count_pairs(piece.block, piece.at, piece.later, piece.later_at, np.uint32(self.levels), counts)
        return np.concatenate(counted)


def pairings(blocks: Iterable[UInt8[np.ndarray, "columns _"]], lag: int, levels: int) -> Iterator[Pairing]:
    """Join every frame with the one `lag` frames later, as the blocks of bins come; holds the last `lag` frames."""
    held: deque[np.ndarray] = deque()
    taken = 0  # frames of held[0] that have met their partner
    behind = 0  # frames that were read and have not
    for block in blocks:
        held.append(block)
        behind += block.shape[1]
        pieces = []
        while behind > lag:
            first = held[0]
            at = block.shape[1] - (behind - lag)
            width = min(first.shape[1] - taken, behind - lag)
            pieces.append(Piece(first, taken, block, at, width))
            taken, behind = taken + width, behind - width
            if taken == first.shape[1]:
                held.popleft()
                taken = 0
        if pieces:
            yield Pairing(tuple(pieces), levels)


def sliding_sums(counts: Iterable[Int[np.ndarray, "_ levels2"]], length: int) -> Iterator[Int[np.ndarray, "_ levels2"]]:
    """C_{m−l+1} + … + C_m for every m ≥ l − 1, in as many pieces as come; O(1) a frame whatever the length."""
    before: np.ndarray | None = None
    for piece in counts:
        recent = piece if before is None else np.concatenate([before, piece])
        sums = np.empty((max(len(recent) - length + 1, 0), recent.shape[1]), np.int64)
        kernels.slide(recent, length, sums)
        before = recent[max(len(recent) - length + 1, 0) :]
        if len(sums):
            yield sums


def joint_entropy(counts: Int[np.ndarray, "frames levels2"]) -> Float[np.ndarray, "frames"]:
    """H = −Σ P ln P with P = counts / Σ counts (Eq. 2), in nats: 0 to ln B². Nothing counted: 0."""
    entropy = np.empty(len(counts))
    kernels.entropy(np.ascontiguousarray(counts, np.int64), entropy)
    return entropy
