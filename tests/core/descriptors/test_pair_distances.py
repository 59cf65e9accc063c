"""Pair distances: rigid motion cancels, everything else shows."""

import numpy as np
import pytest

from caesura.core.descriptors.pair_distances import PAIRS, PairDistances
from tests.animations import bar, turned


@pytest.fixture
def tube():
    return bar()


def test_rigid_motion_cancels(tube):
    """Turned and carried off by ten body lengths, in float32: no distance changes by more than rounding."""
    rest, triangles = tube
    moved = np.stack([turned(rest, angle) + np.array([10, -3, 2]) for angle in (0.0, 0.7, 2.5)]).astype(np.float32)
    assert np.abs(PairDistances.of(rest, triangles).measure(moved)).max() < 1e-5


def test_a_body_of_twice_the_size_has_every_distance_twice(tube):
    """The change of each distance over the body size is the distance over the body size."""
    rest, triangles = tube
    pairs = PairDistances.of(rest, triangles)
    np.testing.assert_allclose(pairs.measure(2 * rest[None])[0], pairs.at_rest / pairs.size, atol=1e-6)


def test_pairs_are_near_and_far(tube):
    """About 600 different pairs, among them neighbours and the two ends of the body."""
    rest, triangles = tube
    pairs = PairDistances.of(rest, triangles)
    assert len(pairs.first) == PAIRS
    assert len({frozenset(p) for p in zip(pairs.first.tolist(), pairs.second.tolist(), strict=True)}) == PAIRS
    assert pairs.size == pytest.approx(1.0, abs=0.02)
    assert pairs.at_rest.min() < 0.1 < 0.8 < pairs.at_rest.max()


def test_a_vertex_that_no_triangle_uses_takes_no_part(tube):
    """A stray point far away neither stretches the body nor is measured."""
    rest, triangles = tube
    strayed = np.concatenate([rest, [[100, 100, 100]]]).astype(np.float32)
    assert PairDistances.of(strayed, triangles).size == PairDistances.of(rest, triangles).size


@pytest.mark.parametrize(("points", "pairs"), [(1, 0), (2, 1), (5, 10)])
def test_a_skeleton_of_few_joints_has_all_its_pairs(points, pairs):
    """Without triangles every vertex counts, and where there are few pairs all are taken."""
    rest = np.random.default_rng(0).normal(size=(points, 3)).astype(np.float32)
    chosen = PairDistances.of(rest, np.zeros((0, 3), np.int64))
    assert len(chosen.first) == pairs
    assert chosen.measure(rest[None]).shape == (1, pairs)
