"""The compiled loops against twins that look at everything."""

from itertools import pairwise

import numpy as np
import pytest
from scipy import sparse

from caesura.core.kernels import switching
from caesura.core.methods.switching.switching_k_means import motion_means, squared_distances
from tests import oracles

RANDOM = np.random.default_rng(1)


@pytest.mark.parametrize("penalty", [0.0, 0.3, 1.0, 10.0])
def test_viterbi_finds_the_cheapest_of_all_labellings(penalty):
    """Against all 3^7 labellings: the same cost, by labels that have it."""
    cost = RANDOM.random((7, 3))
    labels = np.empty(7, np.int64)
    least = switching.viterbi(cost, penalty, labels)
    assert least == pytest.approx(oracles.cheapest_labels(cost, penalty)[0])
    assert least == pytest.approx(cost[np.arange(7), labels].sum() + penalty * np.count_nonzero(np.diff(labels)))


def test_a_change_that_gains_nothing_is_not_made():
    """Where two motions fit equally well, the labels stay."""
    labels = np.empty(5, np.int64)
    switching.viterbi(np.zeros((5, 2)), 0.0, labels)
    assert len(set(labels.tolist())) == 1


@pytest.mark.parametrize(("penalty", "longest"), [(0.1, 10), (1.0, 10), (5.0, 10), (0.1, 3), (5.0, 3)])
def test_partition_is_the_cheapest_of_all(penalty, longest):
    """Against all 2^9 partitions, pruning and the bound on the length of a piece included."""
    values = RANDOM.normal(size=(10, 2)) + 2 * (np.arange(10) > 4)[:, None]
    total = np.concatenate([np.zeros((1, 2)), np.cumsum(values, axis=0)])
    squares = np.concatenate([[0.0], np.cumsum((values**2).sum(axis=1))])
    start_of = np.zeros(11, np.int64)
    switching.least_cost_partition(total, squares, penalty, longest, start_of)
    bounds = [10]
    while bounds[-1] > 0:
        bounds.append(int(start_of[bounds[-1]]))
    pieces = [values[a:b] for b, a in pairwise(bounds)]
    cost = sum(((p - p.mean(axis=0)) ** 2).sum() + penalty for p in pieces)
    assert max(map(len, pieces)) <= longest
    assert cost == pytest.approx(oracles.cheapest_partition(values, penalty, longest))


def test_merges_are_those_of_looking_at_every_pair():
    """Ward's order with remembered neighbours is the order without."""
    means, weights = RANDOM.normal(size=(25, 3)), RANDOM.integers(1, 9, 25).astype(float)
    first, second = np.zeros(24, np.int64), np.zeros(24, np.int64)
    switching.merge_order(means.copy(), weights.copy(), first, second)
    assert list(zip(first.tolist(), second.tolist(), strict=True)) == oracles.ward(means, weights)


@pytest.mark.parametrize("examples", [5, 40, 600])
def test_the_nearest_examples_are_those_of_all_distances_sorted(examples):
    """The mean distance to the five nearest, where some are equally near."""
    poses, known = (RANDOM.normal(size=(n, 30)).astype(np.float32).round(1) for n in (33, examples))
    found = np.empty(33)
    switching.distances_to_nearest(poses, np.ascontiguousarray(known.T), 5, found)
    distances = np.linalg.norm(poses[:, None].astype(np.float64) - known, axis=2)
    np.testing.assert_allclose(found, np.sort(distances, axis=1)[:, :5].mean(axis=1), rtol=1e-6)


def test_links_are_counted_by_label():
    """As by a matrix of all of them."""
    weights = sparse.random(50, 50, 0.2, "csr", random_state=2)
    labels = RANDOM.integers(0, 4, 50)
    links = np.zeros((4, 4))
    switching.add_links(weights.data, weights.indices, weights.indptr, labels, links)
    member = np.eye(4)[labels]
    np.testing.assert_allclose(links, member.T @ weights.toarray() @ member, rtol=1e-12)


def test_means_and_distances_of_motions_are_those_of_their_rows():
    """Motion by motion."""
    values, labels = RANDOM.normal(size=(90, 7)), np.arange(90) % 4
    means = motion_means(values, labels, 4)
    np.testing.assert_allclose(means, [values[labels == k].mean(axis=0) for k in range(4)], rtol=1e-12)
    squares = squared_distances(values, np.einsum("sd,sd->s", values, values), means)
    np.testing.assert_allclose(squares, ((values[:, None] - means) ** 2).sum(axis=2), atol=1e-12)
    assert (squared_distances(values, np.einsum("sd,sd->s", values, values), values) >= 0).all()
