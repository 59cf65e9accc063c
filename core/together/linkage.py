"""Linkage: the segments of all takes grouped into motions.

Ward's linkage (1963) of the distances between signatures. What a take's own cut says is evidence and no rule: segments
that it put together are drawn together, and those that it kept apart are pushed apart.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

ALIKE = 0.75
"""Where nobody says how many motions there are, two groups that are nearer than this, on average, are one."""
TOGETHER = 0.25
"""Times so much are segments apart that their take calls one motion."""
APART = 4.0
"""So much farther are those that their take calls two: twice as far as any two stretches at random, so that it takes a
number of motions that somebody asked for to join them."""
CONFLICT = 1.0
"""So much farther are two groups that takes keep apart, for the share of the smaller group that is kept apart."""

Tree = Float[np.ndarray, "merges 4"]


def link_segments(
    distances: Float[np.ndarray, "n n"],
    takes: Int[np.ndarray, "n"],
    own_motions: Int[np.ndarray, "n"],
    motions: int | None,
) -> Int[np.ndarray, "n"]:
    """A motion for every segment, numbered from 0: of `motions`, or of as many as differ where that is None.

    `distances` are squared; `takes` and `own_motions` say which take a segment is of, and which motion it is there.
    O(n²).
    """
    if len(distances) < 2:
        return np.zeros(len(distances), np.int64)
    known = weigh_own_cuts(distances, takes, own_motions)
    tree = linkage(squareform(np.sqrt(known), checks=False), "ward")
    if motions is not None:
        return np.asarray(fcluster(tree, motions, "maxclust") - 1, np.int64)
    return _cut_tree(tree, distances, takes, own_motions)


def weigh_own_cuts(
    distances: Float[np.ndarray, "n n"], takes: Int[np.ndarray, "n"], own_motions: Int[np.ndarray, "n"]
) -> Float[np.ndarray, "n n"]:
    """The distances with what each take's own cut says: symmetric, zero on the diagonal."""
    same_take = takes[:, None] == takes[None, :]
    same_motion = same_take & (own_motions[:, None] == own_motions[None, :])
    known = (distances + distances.T) / 2
    known = np.where(same_motion, known * TOGETHER, known + APART * (same_take & ~same_motion))
    np.fill_diagonal(known, 0.0)
    return np.asarray(known)


def _cut_tree(
    tree: Tree, distances: Float[np.ndarray, "n n"], takes: Int[np.ndarray, "n"], own_motions: Int[np.ndarray, "n"]
) -> Int[np.ndarray, "n"]:
    """The largest groups of the tree all of whose parts are alike."""
    count = len(distances)
    members = {i: np.array([i]) for i in range(count)}
    labels = np.arange(count)
    for number, (first, second) in enumerate(tree[:, :2].astype(np.int64).tolist(), start=count):
        if first not in members or second not in members:
            continue
        one, other = members[first], members[second]
        apart = float(distances[np.ix_(one, other)].mean())
        if apart + CONFLICT * conflict_share(one, other, takes, own_motions) > ALIKE:
            continue
        members[number] = np.concatenate([one, other])
        labels[members[number]] = number
    return np.asarray(np.unique(labels, return_inverse=True)[1], np.int64)


def conflict_share(
    one: Int[np.ndarray, "a"],
    other: Int[np.ndarray, "b"],
    takes: Int[np.ndarray, "n"],
    own_motions: Int[np.ndarray, "n"],
) -> float:
    """Of the smaller of two groups of segments, how many are kept apart from the other group by their own take, 0 to 1.

    A take that calls some segments of both by one motion keeps none of them apart.
    """
    kept = 0
    for take in np.intersect1d(takes[one], takes[other]).tolist():
        mine, theirs = own_motions[one[takes[one] == take]], own_motions[other[takes[other] == take]]
        if len(np.intersect1d(mine, theirs)) == 0:
            kept += min(len(mine), len(theirs))
    return kept / min(len(one), len(other))
