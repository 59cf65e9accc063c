"""Groups by eigenvectors, and runs too short to keep."""

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.short_runs import remove_short_runs
from caesura.core.methods.alignment.spectral_clustering import cluster_spectrally


@pytest.mark.parametrize("size", [40, 400])
def test_rings_are_told_apart(size):
    """Two rings and a point cloud, which no k-means could tell apart, of few rows and of many."""
    random = np.random.default_rng(1)
    angle = np.tile(2 * np.pi * np.arange(size) / size, 2)
    radius = np.repeat([4.0, 8.0], size) + random.normal(0, 0.05, 2 * size)
    rings = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    values = np.concatenate([rings, random.normal(0, 0.2, (size, 2))])
    distance = np.linalg.norm(values[:, None] - values[None], axis=2)
    kernel = np.exp(-(distance**2))
    assert frame_accuracy(cluster_spectrally(kernel, 3, seed=0), np.repeat([0, 1, 2], size)) == 1


def test_more_groups_than_differ_are_not_made_up():
    """Two poses held: two groups, whatever was asked for."""
    kernel = frame_kernel(np.repeat([[0.0], [5.0]], 10, axis=0))
    assert len(np.unique(cluster_spectrally(kernel, 4, seed=0))) == 2
    assert cluster_spectrally(kernel, 1, seed=0).tolist() == [0] * 20
    assert cluster_spectrally(np.ones((1, 1)), 3, seed=0).tolist() == [0]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("aabbbbcc", "bbbbbbbb"),
        ("aaaabccccc", "aaaaaccccc"),
        ("aaaabbcccc", "aaaaaccccc"),
        ("aaaabbb", "aaaaaaa"),
        ("aaaa", "aaaa"),
        ("ab", "bb"),
    ],
)
def test_short_runs_go_to_their_neighbours(before, after):
    """The shortest first; at an end whole, in the middle half to either side, the odd one to the left."""
    found = remove_short_runs(np.array([ord(c) for c in before]), 4)
    assert "".join(map(chr, found)) == after
