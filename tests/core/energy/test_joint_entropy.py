"""Joint counts, sliding sums and the energy curve, against a double loop."""

import numpy as np
import pytest

from caesura.core.energy.energy_curve import compute_energy_curve, frames_per_window
from caesura.core.energy.joint_entropy import compute_joint_entropy, compute_sliding_sums, plan_frame_pairings
from tests import oracles


def blocks(bins, sizes):
    """(columns, frames) cut into blocks of these sizes in turn, to the end."""
    start, cut = 0, []
    while start < bins.shape[1]:
        size = sizes[len(cut) % len(sizes)]
        cut.append(np.ascontiguousarray(bins[:, start : start + size]))
        start += size
    return cut


@pytest.mark.parametrize("window", [1, 2, 5, 13])
@pytest.mark.parametrize("sizes", [(64,), (1,), (7,), (3, 11)])
def test_the_curve_is_the_double_loops(window, sizes):
    """Eq. 3 (and Eq. 1 with windows of one frame), whatever the blocks and the windows."""
    bins = np.random.default_rng(2).integers(0, 4, (9, 40)).astype(np.uint8)
    expected = oracles.energy(bins.T, 4, window)
    for threads in (1, 2):
        found = compute_energy_curve(blocks(bins, sizes), 40, window, 4, threads)
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)


def test_the_curve_is_nan_where_the_windows_do_not_fit():
    """Defined for l − 1 ≤ m ≤ M − l − 1 alone, and nowhere when two windows are longer than the take."""
    still = np.zeros((3, 20), np.uint8)
    assert np.flatnonzero(~np.isnan(compute_energy_curve([still], 20, 6, 2))).tolist() == list(range(5, 14))
    assert np.isnan(compute_energy_curve([still], 20, 11, 2)).all()


def test_entropy_of_known_distributions():
    """One cell 0, n equal cells ln n, nothing counted 0."""
    counts = np.array([[8, 0, 0, 0], [2, 2, 2, 2], [4, 4, 0, 0], [0, 0, 0, 0]])
    np.testing.assert_allclose(compute_joint_entropy(counts), [0, np.log(4), np.log(2), 0], atol=1e-15)


def test_every_frame_meets_the_one_a_lag_later_once():
    """Each pair (n, n + l) is counted for every column, in order."""
    bins = np.random.default_rng(3).integers(0, 3, (5, 50)).astype(np.uint8)
    found = np.concatenate([p.counts() for p in plan_frame_pairings(blocks(bins, (8,)), 11, 3)])
    expected = np.zeros((39, 9), int)
    for n in range(39):
        np.add.at(expected[n], bins[:, n] * 3 + bins[:, n + 11], 1)
    np.testing.assert_array_equal(found, expected)


def test_sliding_sums_are_sums_of_the_last_rows():
    """In whatever pieces the rows come."""
    rows = np.random.default_rng(4).integers(0, 9, (30, 4))
    expected = [rows[m - 6 : m + 1].sum(axis=0) for m in range(6, 30)]
    for size in (1, 4, 30):
        found = np.concatenate(list(compute_sliding_sums([rows[i : i + size] for i in range(0, 30, size)], 7)))
        np.testing.assert_array_equal(found, expected)


def test_windows_are_seconds_at_the_rate_of_the_file():
    """1.3 s at 30 frames a second are 39 frames, of neighbours 1; never none."""
    assert frames_per_window("modified", 1.3, 30.0) == 39
    assert frames_per_window("joint", 1.3, 30.0) == 1
    assert frames_per_window("modified", 0.001, 30.0) == 1
