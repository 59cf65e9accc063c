"""How alike two frames are, and which frames stand for others."""

import numpy as np

from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.sample_rate import most_frames_per_sample, seconds_to_samples
from caesura.core.methods.alignment.temporal_reduction import reduce_frames


def test_the_kernel_is_a_gaussian_as_wide_as_neighbours_are_apart():
    """100 points on a line: the nearest 2 % are the point itself and a neighbour, half a step away on average."""
    kernel = frame_kernel(np.arange(100.0)[:, None])
    distance = np.subtract.outer(np.arange(100), np.arange(100))
    np.testing.assert_allclose(kernel, np.exp(-(distance**2) / (2 * 0.5**2)), atol=1e-9)


def test_frames_that_are_all_the_same_are_wholly_alike():
    """No distance to divide by."""
    np.testing.assert_array_equal(frame_kernel(np.ones((7, 3))), np.ones((7, 7)))


def test_blocks_end_where_looks_change_and_when_they_are_full():
    """Two looks of 7 and 4 frames, blocks of at most 5."""
    values = np.repeat([[0.0], [9.0]], [7, 4], axis=0)
    found = reduce_frames(values, 5, seed=0)
    assert found.bounds.tolist() == [0, 5, 7, 11]
    assert found.of(values).ravel().tolist() == [0, 0, 9]
    assert found.per_frame(np.array([0, 1, 2])).tolist() == [0] * 5 + [1] * 2 + [2] * 4


def test_a_slow_take_is_not_reduced():
    """At 24 and 30 frames a second every frame counts; at 120, five are one as the authors have it."""
    assert [most_frames_per_sample(rate) for rate in (24.0, 30.0, 60.0, 120.0)] == [1, 1, 2, 5]
    assert reduce_frames(np.ones((4, 1)), 1, seed=0).bounds.tolist() == [0, 1, 2, 3, 4]
    assert seconds_to_samples(1.27, 960, 4579 / 120) == 32
