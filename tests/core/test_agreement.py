"""How far a segmentation agrees with a truth, against cases worked by hand."""

import numpy as np
import pytest

from caesura.core.agreement import (
    adjusted_rand_index,
    boundary_scores,
    cut_frames,
    error_measure,
    frame_accuracy,
    rand_index,
    segment_f1,
)


def labels(text):
    """One motion a letter."""
    return np.array([ord(letter) for letter in text])


def test_names_of_motions_do_not_matter():
    """Swapped labels agree in full by every measure."""
    one, other = labels("aaabbbcc"), labels("ccaaabbb"[2:] + "cc")
    assert frame_accuracy(one, other) == adjusted_rand_index(one, other) == 1
    assert segment_f1(one, other, 0.5).f1 == 1


def test_a_label_too_many_counts_as_wrong():
    """Of eight frames, two carry a third label that the truth does not have: six are right."""
    assert frame_accuracy(labels("aaaabbcc"), labels("xxxxyyyy")) == 6 / 8


def test_the_best_matching_is_not_the_greedy_one():
    """a covers x 3 times and y 2 times, b covers x 2 times: matching a to y and b to x gives 4 of 7, not 3."""
    assert frame_accuracy(labels("aaaaabb"), labels("xxxyyxx")) == 4 / 7


def test_the_error_measure_counts_the_pairs_that_differ():
    """Pair by pair (Eq. 6 read with the truth); the Rand index, which figure 7 shows, is what it leaves."""
    draw = np.random.default_rng(0)
    found, true = draw.integers(0, 3, 30), draw.integers(0, 4, 30)
    differ = sum((found[i] == found[j]) != (true[i] == true[j]) for i in range(30) for j in range(30) if i != j)
    assert error_measure(found, true) == pytest.approx(differ / (30 * 29))
    assert error_measure(found, true) == 1 - rand_index(found, true)


def test_rand_index_counts_pairs():
    """aab against xyy: of three pairs only the outer one is judged alike, and by chance more would be."""
    assert rand_index(labels("aab"), labels("xyy")) == pytest.approx(1 / 3)
    assert rand_index(labels("ab"), labels("xy"), np.array([2, 1])) == rand_index(labels("a"), labels("x")) == 1
    assert adjusted_rand_index(labels("aab"), labels("xyy")) == pytest.approx(-0.5)


def test_one_motion_found_where_there_are_two_is_chance():
    """A segmentation that says nothing has an adjusted Rand index of zero."""
    assert adjusted_rand_index(labels("aaaa"), labels("xxyy")) == 0


def test_a_true_cut_is_found_once():
    """Two cuts beside one true cut: one is a hit, the other a mistake."""
    found = boundary_scores(np.array([98, 102]), np.array([100]), 5)
    assert (found.precision, found.recall, found.f1) == (1 / 2, 1, 2 / 3)


def test_the_tolerance_is_inclusive():
    """Five frames off is found within five and not within four."""
    assert boundary_scores(np.array([105]), np.array([100]), 5).f1 == 1
    assert boundary_scores(np.array([105]), np.array([100]), 4).f1 == 0


def test_cuts_are_matched_so_that_most_are_hit():
    """6 could take 4 or 9, but 2 needs 4: all three of each are matched."""
    assert boundary_scores(np.array([2, 6, 12]), np.array([4, 9, 13]), 3).f1 == 1


@pytest.mark.parametrize(("cuts", "true", "f1"), [([], [], 1), ([], [5], 0), ([5], [], 0)])
def test_no_cuts_at_all(cuts, true, f1):
    """Nothing found where there is nothing is perfect, else nothing is right."""
    assert boundary_scores(np.array(cuts, int), np.array(true, int), 3).f1 == f1


def test_segments_are_hit_by_overlap():
    """The first segment overlaps by 3 of 5 and the second by 3 of 5: hits at a half, none at three quarters."""
    found, true = labels("aaaaabbb"), labels("aaabbbbb")
    assert segment_f1(found, true, 0.5).f1 == 1
    assert segment_f1(found, true, 0.75).f1 == 0


def test_a_shattered_segment_is_hit_once():
    """a b a b a over one true segment: at a tenth overlap one of five pieces is a hit."""
    scores = segment_f1(labels("aaababaaaa"), labels("xxxxxxxxxx"), 0.1)
    assert (scores.precision, scores.recall) == (1 / 5, 1)


def test_cuts_are_first_frames():
    """aab|b|a: frames 2 and 4 begin segments."""
    assert cut_frames(labels("aabba")).tolist() == [2, 4]


def test_unequal_lengths_are_refused():
    """A truth of another length is a mistake of the caller."""
    with pytest.raises(ValueError, match="every frame"):
        frame_accuracy(labels("aa"), labels("aab"))
