"""The compiled loops of aligned cluster analysis against slow twins that try everything."""

from itertools import pairwise

import numpy as np
import pytest

from caesura.core.kernels import alignment
from caesura.core.methods.alignment.dynamic_time_alignment import dynamic_time_alignment_kernel
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.initial_segmentation import segments_of_grouped_samples
from caesura.core.methods.alignment.segments import SegmentLengths, Segments
from tests import oracles


def row_of_samples(samples, seed):
    """A kernel of a random walk, and weights."""
    random = np.random.default_rng(seed)
    return frame_kernel(random.normal(size=(samples, 2)).cumsum(axis=0)), random.integers(1, 9, samples).astype(float)


@pytest.mark.parametrize("seed", range(5))
def test_segments_are_aligned_by_the_best_of_all_paths(seed):
    """For every pair of segments, weighted samples, lengths 1 to 5."""
    kernel, weights = row_of_samples(12, seed)
    bounds = np.array([0, 1, 4, 9, 12])
    found = dynamic_time_alignment_kernel(kernel, weights, bounds)
    pieces = [slice(a, b) for a, b in pairwise(bounds)]
    expected = [[oracles.dtak(kernel[p, q], weights[p], weights[q]) for q in pieces] for p in pieces]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_a_segment_is_wholly_like_itself_at_any_speed():
    """Every sample twice: the alignment finds each one's likeness, 1."""
    values = np.random.default_rng(0).normal(size=(6, 2)).cumsum(axis=0)
    kernel = frame_kernel(np.concatenate([values, np.repeat(values, 2, axis=0)]))
    found = dynamic_time_alignment_kernel(kernel, np.ones(18), np.array([0, 6, 18]))
    np.testing.assert_allclose(found, 1, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("weighted", [False, True])
def test_the_best_segmentation_of_all_is_found(seed, weighted):
    """Ten samples, two groups: no segmentation costs less, and the one that is answered costs that."""
    kernel, weights = row_of_samples(10, seed)
    weights = weights if weighted else np.ones(10)
    bounds, labels = np.array([0, 3, 5, 8, 10]), np.array([0, 1, 0, 1])
    members = (labels == np.arange(2)[:, None]) / 2
    spread = np.einsum("ci,ij,cj->c", members, dynamic_time_alignment_kernel(kernel, weights, bounds), members)
    head, group = np.empty(10, np.int64), np.empty(10, np.int64)
    cost = alignment.cut_anew(kernel, weights, bounds, labels, spread, 4, head, group)
    assert cost == pytest.approx(oracles.least_recut(kernel, weights, bounds, labels, 4), abs=1e-12)
    assert Segments.traced(head, group).lengths.max() <= 4


@pytest.mark.parametrize("longest", [1, 3, 20])
def test_likeness_that_persists_is_propagated(longest):
    """As by looking at every pair and every lag."""
    kernel, _ = row_of_samples(11, longest)
    out = np.zeros_like(kernel)
    alignment.persistent_likeness(kernel, longest, out)
    np.testing.assert_array_equal(out, oracles.persistent(kernel, longest))


@pytest.mark.parametrize("seed", range(5))
def test_segments_hold_as_few_strangers_as_can_be(seed):
    """Over every segmentation with the allowed lengths."""
    groups = np.random.default_rng(seed).integers(0, 3, 13)
    found = segments_of_grouped_samples(groups, SegmentLengths(2, 5))
    assert found.bounds[-1] == 13
    assert found.lengths.min() >= 2
    assert found.lengths.max() <= 5
    assert np.count_nonzero(found.per_sample != groups) == oracles.fewest_strangers(groups, 2, 5)


def test_lengths_as_measured_are_the_shortest_while_strangers_are_few():
    """What the authors' program does: shortest segments until the strangers exceed that length, then the longest."""
    clean = segments_of_grouped_samples(np.repeat([0, 1], 12), SegmentLengths(4, 8), as_measured=True)
    assert clean.lengths.tolist() == [4] * 6
    mixed = segments_of_grouped_samples(np.arange(40) % 5, SegmentLengths(4, 8), as_measured=True)
    assert mixed.lengths.max() == 8


@pytest.mark.parametrize("samples", [1, 2, 5, 31, 61, 63, 64, 200, 1000])
def test_lengths_can_always_tile(samples):
    """Some number of segments within the lengths makes exactly so many samples; they change only if they must."""
    lengths = SegmentLengths(32, 60).within(samples)
    counts = range(1, samples + 1)
    assert any(n * lengths.shortest <= samples <= n * lengths.longest for n in counts)
    if any(n * 32 <= samples <= n * 60 for n in counts):
        assert lengths.shortest == 32
