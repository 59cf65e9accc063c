"""The neighbour graph: moments of a take, each linked to those most like it elsewhere and to those soon before and
after.

A motion is a part of the graph with few links to the rest: its repetitions are like each other, and the phases of a
slow rhythm, unlike as they are, follow each other again and again. So labellings that were found by any means can be
compared: that of the least normalised cut is the best (Shi and Malik, 2000).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy import sparse

from caesura.core.frames.blocks import Block, map_blocks, split_into_blocks
from caesura.core.kernels import switching

SAMPLES_PER_SECOND = 10.0
MOST_SAMPLES = 6000
NEIGHBOURS = 10
APART_SECONDS = 1.25
"""Nearer in time a moment is like itself, which says nothing. Much farther there is nothing left of a short segment."""
ALIKE = 0.45
"""How far apart moments can be and still be alike, as a share of how far all stray from their mean: a motion performed
once has neighbours too, but none like it."""
FOLLOWING_SECONDS = 1.5
"""How far the links to what follows reach; together they weigh as much as the links to what is like."""
DELAY_SECONDS = 0.3
"""A moment is a pose with the one before and the one after."""
BLOCK = 500


@dataclass(frozen=True)
class NeighbourGraph:
    """Weights of links between moments, symmetric, and the frame of each moment."""

    weights: sparse.csr_matrix
    at: Int[np.ndarray, "moments"]

    @classmethod
    def of(cls, poses: Float[np.ndarray, "frames D"], frame_rate: float, threads: int = 1) -> "NeighbourGraph":
        """Of poses, at most `MOST_SAMPLES` moments: time and memory grow with the frames no more than to read them.

        A link to one of the 10 most like moments weighs exp(−d² / σσ'). Each moment's σ is its distance to its fifth
        nearest (Zelnik-Manor and Perona, 2004), bounded: σ⁻² = distance⁻² + (0.45 s)⁻², s being the deviation of all.
        """
        stride = max(round(frame_rate / SAMPLES_PER_SECOND), -(-len(poses) // MOST_SAMPLES), 1)
        at = np.minimum(np.arange(0, len(poses), stride) + stride // 2, len(poses) - 1)
        delay = round(DELAY_SECONDS * frame_rate)
        moments = np.concatenate([poses[np.clip(at + by, 0, len(poses) - 1)] for by in (-delay, 0, delay)], axis=1)
        per_second = frame_rate / stride
        alike = _alike(moments, max(round(APART_SECONDS * per_second), 1), threads)
        following = _following(len(at), max(round(FOLLOWING_SECONDS * per_second), 1))
        scale = alike.sum() / following.sum() if len(at) > 1 and alike.sum() > 0 else 1.0
        return cls((alike + following * scale).tocsr(), at)

    def cut(self, labels: Int[np.ndarray, "frames"]) -> float:
        """The normalised cut: Σ over motions of the share of their links that lead to another motion."""
        found = np.unique(labels[self.at], return_inverse=True)[1]
        links = np.zeros((int(found.max()) + 1,) * 2)
        switching.add_links(self.weights.data, self.weights.indices, self.weights.indptr, found, links)
        volume = links.sum(axis=1)
        return float(((volume - np.diag(links)) / np.maximum(volume, _TINY)).sum())


_TINY = float(np.finfo(np.float64).tiny)


def _alike(moments: Float[np.ndarray, "moments D"], apart: int, threads: int) -> sparse.csr_matrix:
    """Links to the most like moments that are farther than `apart` in time; none where there are too few."""
    count = len(moments)
    near = min(NEIGHBOURS, count - 2 * apart - 1)
    if near < 1:
        return sparse.csr_matrix((count, count))
    squares = np.einsum("md,md->m", moments, moments)
    nearest = np.empty((count, near), np.int64)
    square = np.empty((count, near))
    index = np.arange(count)

    def find_nearest(block: Block) -> None:
        rows = index[slice(*block)]
        apart_squares = squares[rows, None] + squares - 2 * moments[rows] @ moments.T
        for row, of_row in zip(rows.tolist(), apart_squares, strict=True):
            of_row[max(row - apart, 0) : row + apart + 1] = np.inf
        chosen = np.argpartition(apart_squares, near - 1, axis=1)[:, :near]
        nearest[rows] = chosen
        square[rows] = np.maximum(np.take_along_axis(apart_squares, chosen, 1), 0.0)

    for _ in map_blocks(find_nearest, split_into_blocks(count, BLOCK), threads):
        pass
    rounding = 1e-12 * float(squares.mean()) + _TINY
    fifth = np.partition(square, near // 2, axis=1)[:, near // 2]
    bound = ALIKE**2 * float(moments.var(axis=0).sum())
    scale = np.sqrt(fifth * bound / (fifth + bound + rounding))
    weight = np.exp(-square / (scale[:, None] * scale[nearest] + rounding))
    links = sparse.csr_matrix((weight.ravel(), (np.repeat(index, near), nearest.ravel())), (count, count))
    return links + links.T


def _following(count: int, reach: int) -> sparse.csr_matrix:
    """Links of weight 1 between moments at most `reach` apart."""
    first = np.repeat(np.arange(count), reach)
    second = first + np.tile(np.arange(1, reach + 1), count)
    first, second = first[second < count], second[second < count]
    links = sparse.csr_matrix((np.ones(len(first)), (first, second)), (count, count))
    return links + links.T
