"""Agreement of a segmentation with a known truth: labels frame by frame, cuts, and whole segments.

Labels are any integers; only which frames share one matters. The paper's Eq. 6 never mentions the truth; its sensible
reading, the share of frame pairs on which both agree, is the Rand index.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Int

Labels = Int[np.ndarray, "_"]
Cuts = Int[np.ndarray, "_"]
Lengths = Int[np.ndarray, "_"]


class Scores(NamedTuple):
    """Shares, 0 to 1. Precision: of what was found, how much is true; recall: of what is true, how much was found."""

    precision: float
    recall: float
    f1: float


def frame_accuracy(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> float:
    """Share of frames whose label is right under the best one-to-one matching of labels (Hungarian), 0 to 1.

    A label too many matches nothing, and its frames count as wrong. With `lengths`, each entry of both stands for so
    many frames.
    """
    _check_labels(labels, truth)
    counts = _contingency(labels, truth, lengths)
    return float(counts[_matching(counts)].sum() / counts.sum())


def rand_index(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> float:
    """Share of pairs of frames that both put together or both keep apart, 0 to 1.

    The reading of the paper's Eq. 6 that uses the truth. With `lengths`, each entry of both stands for so many frames,
    at most 10⁹ in all. One frame alone agrees.
    """
    neither, found, true, both = _count_pairs(labels, truth, lengths)
    pairs = neither + found + true + both
    return (neither + both) / pairs if pairs else 1.0


def error_measure(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> float:
    """Share of pairs of frames that one puts together and the other keeps apart, 0 to 1 (Eq. 6, read with the truth).

    One less the Rand index, which the paper's figure 7 shows as accuracy. With `lengths` as there.
    """
    return 1.0 - rand_index(labels, truth, lengths)


def adjusted_rand_index(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> float:
    """The Rand index corrected for chance: 1 where both agree, 0 expected of chance, down to −0.5 (Hubert 1985).

    With `lengths`, each entry of both stands for so many frames, at most 10⁹ in all.
    """
    neither, found, true, both = _count_pairs(labels, truth, lengths)
    if found == true == 0:
        return 1.0
    chance = (both + true) * (true + neither) + (both + found) * (found + neither)
    return 2 * (both * neither - true * found) / chance


def boundary_scores(cuts: Cuts, truth_cuts: Cuts, tolerance_frames: int) -> Scores:
    """Cuts that are true within the tolerance (inclusive), each matched to at most one of the other side.

    Nothing to find and nothing found is perfect. Between two sorted rows the greedy matching is a largest one.
    """
    cuts, truth_cuts = np.sort(cuts), np.sort(truth_cuts)
    hits = i = j = 0
    while i < len(cuts) and j < len(truth_cuts):
        if abs(int(cuts[i]) - int(truth_cuts[j])) <= tolerance_frames:
            hits, i, j = hits + 1, i + 1, j + 1
        elif cuts[i] < truth_cuts[j]:
            i += 1
        else:
            j += 1
    return _scores(hits, len(cuts), len(truth_cuts))


def segment_f1(labels: Labels, truth: Labels, overlap: float) -> Scores:
    """Segments of the right motion that overlap a true one by `overlap` of their union or more (Lea 2017: F1@10, …).

    Labels are matched one to one first, as for the frame accuracy. Each true segment is hit once, by the best overlap.
    """
    _check_labels(labels, truth)
    found, true = (
        _segments_of_labels(_match_labels(labels, truth)),
        _segments_of_labels(_as_consecutive_integers(truth)),
    )
    hit = np.zeros(len(true), bool)
    hits = 0
    for name, start, stop in found:
        overlaps = [
            _overlap((start, stop), other[1:]) if other[0] == name and not hit[i] else 0.0
            for i, other in enumerate(true)
        ]
        best = int(np.argmax(overlaps))
        if overlaps[best] > 0 and overlaps[best] >= overlap:
            hit[best] = True
            hits += 1
    return _scores(hits, len(found), len(true))


def cut_frames(labels: Labels) -> Cuts:
    """The first frame of every segment but the first."""
    return np.flatnonzero(np.diff(labels)) + 1


def _scores(hits: int, found: int, true: int) -> Scores:
    if found == 0 and true == 0:
        return Scores(1.0, 1.0, 1.0)
    precision, recall = hits / found if found else 0.0, hits / true if true else 0.0
    return Scores(precision, recall, 2 * hits / (found + true))


def _check_labels(labels: Labels, truth: Labels) -> None:
    if len(labels) != len(truth):
        raise ValueError(f"{len(labels)} labels against {len(truth)} true ones: both must have one for every frame")
    if len(truth) == 0:
        raise ValueError("there is no frame to compare")


def _as_consecutive_integers(labels: Labels) -> Labels:
    return np.asarray(np.unique(labels, return_inverse=True)[1])


def _contingency(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> Int[np.ndarray, "found true"]:
    """counts[i, j]: frames with the i-th label and the j-th true one."""
    found, true = _as_consecutive_integers(labels), _as_consecutive_integers(truth)
    counts = np.zeros((found.max() + 1, true.max() + 1), np.int64)
    np.add.at(counts, (found, true), 1 if lengths is None else lengths)
    return counts


def _matching(counts: Int[np.ndarray, "found true"]) -> tuple[Int[np.ndarray, "m"], Int[np.ndarray, "m"]]:
    """The rows and columns that belong together for the largest sum (Hungarian)."""
    from scipy.optimize import linear_sum_assignment  # noqa: PLC0415  a tenth of a second that no segmentation needs

    return linear_sum_assignment(counts, maximize=True)  # type: ignore[no-any-return]


def _count_pairs(labels: Labels, truth: Labels, lengths: Lengths | None = None) -> tuple[int, int, int, int]:
    """Ordered pairs of frames that share a label in neither, only the found, only the true, and both labellings.

    Counted by groups and not by pairs: a cut of a take asks for this ten times.
    """
    _check_labels(labels, truth)
    counts = _contingency(labels, truth, lengths)
    frames = int(counts.sum())
    both = int(np.sum(counts**2)) - frames
    found = int(np.sum(counts.sum(axis=1) ** 2)) - frames - both
    true = int(np.sum(counts.sum(axis=0) ** 2)) - frames - both
    return frames * (frames - 1) - both - found - true, found, true, both


def _match_labels(labels: Labels, truth: Labels) -> Labels:
    """The labels renamed to the true ones they match, and unmatched ones to −1, −2, …"""
    counts = _contingency(labels, truth)
    names = -1 - np.arange(len(counts))
    rows, columns = _matching(counts)
    names[rows] = columns
    return np.asarray(names[_as_consecutive_integers(labels)])


def _segments_of_labels(labels: Labels) -> list[tuple[int, int, int]]:
    """(label, start, stop) of every segment."""
    bounds = [0, *cut_frames(labels).tolist(), len(labels)]
    return [(int(labels[a]), a, b) for a, b in pairwise(bounds)]


def _overlap(one: tuple[int, int], other: tuple[int, int]) -> float:
    """Length of the intersection over that of the union."""
    shared = max(min(one[1], other[1]) - max(one[0], other[0]), 0)
    return shared / (max(one[1], other[1]) - min(one[0], other[0])) if shared else 0.0
