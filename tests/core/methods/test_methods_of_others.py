"""The methods that the paper names, each against a plain implementation of its own on three small takes."""

import itertools

import numpy as np
import pytest
from scipy.cluster.hierarchy import fcluster, linkage

from caesura.core.methods import hidden_markov, velocity_minima
from caesura.core.methods.alignment.frame_kernel import NEAREST
from caesura.core.methods.barbic2004 import gmm, pca, ppca
from caesura.core.methods.reconstruction.curve_simplification import simplify
from caesura.core.methods.reconstruction.genetic import breed_key_frames
from caesura.core.methods.reconstruction.key_frame_motions import label_by_nearest_key
from caesura.core.methods.reconstruction.reconstruction_error import ReconstructionError
from caesura.core.methods.segment_groups import describe_segments, label_segments
from tests.core.methods.test_comparison import RATE, performance

TAKES = {
    "three motions": performance(),
    "two motions that return": performance((0, 1, 0), 6.0, seed=4, components=4),
    "four motions": performance((0, 1, 2, 3), 5.0, seed=9, components=8),
}
each = pytest.mark.parametrize("take", TAKES)


def same_grouping(a, b):
    return len(set(zip(a.tolist(), b.tolist(), strict=True))) == len(set(a.tolist())) == len(set(b.tolist()))


def plain_pca_bounds(values, first, lag):
    """A decomposition of all frames of the segment, anew at each of them."""
    bounds = [0]
    while len(values) - bounds[-1] > first + 2 * lag:
        part, errors, dimensions = values[bounds[-1] :], [], None
        for count in range(first, len(part) + 1):
            singular = np.linalg.svd(part[:count] - part[:count].mean(axis=0), compute_uv=False) ** 2
            if dimensions is None:
                kept = np.cumsum(singular) / singular.sum()
                dimensions = next(r for r in range(1, len(kept) + 1) if kept[r - 1] >= pca.KEPT)
            errors.append(singular[dimensions:].sum())
            rises = [errors[i] - errors[i - lag] for i in range(lag, len(errors))]
            if len(errors) > 2 * lag and rises[-1] > np.mean(rises[:-1]) + pca.DEVIATIONS * np.std(rises[:-1]):
                bounds.append(bounds[-1] + count - 1)
                break
        else:
            break
    return [*bounds, len(values)]


@each
def test_principal_components_cut_where_a_decomposition_of_every_frame_does(take):
    """To the frame, and more than once."""
    values, _ = TAKES[take]
    found = pca.find_pca_bounds(values, RATE).tolist()
    assert found == plain_pca_bounds(values, round(2 * RATE), round(0.5 * RATE))
    assert len(found) > 3


def plain_heights(values, ahead, step):
    """H of every K, with the matrix of the Gaussian written out and inverted."""
    heights = {}
    for count in range(ahead, len(values) - ahead + 1, step):
        known, coming = values[:count], values[count : count + ahead]
        variances, directions = np.linalg.eigh(np.cov(known.T, bias=True))
        kept = 1
        while variances[-kept:].sum() < ppca.KEPT * variances.sum():
            kept += 1
        noise = variances[:-kept].mean() if kept < len(variances) else variances[0]
        spread = directions[:, -kept:] * np.sqrt(variances[-kept:] - noise)
        model = spread @ spread.T + noise * np.eye(values.shape[1])
        inverse = np.linalg.inv(model)
        heights[count] = float(np.mean([(x - known.mean(axis=0)) @ inverse @ (x - known.mean(axis=0)) for x in coming]))
    return heights


@each
def test_probabilistic_components_are_as_far_as_the_inverted_matrix_says(take):
    """At every K; so the cuts, which are its peaks, are those of the plain curve."""
    values, truth = TAKES[take]
    ahead, step = round(1.25 * RATE), round(RATE / 12)
    found = dict(ppca.distances_ahead(values, ahead, step, floor=0.0))
    plain = plain_heights(values, ahead, step)
    assert found.keys() == plain.keys()
    np.testing.assert_allclose(list(found.values()), list(plain.values()), rtol=1e-6)
    bounds = ppca.find_ppca_bounds(values, RATE)
    true = np.flatnonzero(np.diff(truth)) + 1
    assert all(np.abs(bounds - cut).min() <= 0.25 * RATE for cut in true)


def plain_mixture(poses, labels, motions):
    """Expectation maximisation from a labelling on, by the book."""
    share = np.eye(motions)[labels]
    for _ in range(60):
        weights = share.sum(axis=0)
        means = share.T @ poses / weights[:, None]
        logs = []
        for k in range(motions):
            apart = poses - means[k]
            covariance = (share[:, k, None] * apart).T @ apart / weights[k] + gmm.ROUNDING * np.eye(poses.shape[1])
            far = np.einsum("fd,de,fe->f", apart, np.linalg.inv(covariance), apart)
            logs.append(np.log(weights[k] / len(poses)) - 0.5 * (far + np.linalg.slogdet(covariance)[1]))
        logs = np.stack(logs, axis=1)
        share = np.exp(logs - np.logaddexp.reduce(logs, axis=1, keepdims=True))
    return share.argmax(axis=1)


@each
def test_the_mixture_labels_frames_as_plain_expectation_maximisation_does(take):
    """From the truth on, to which it comes back."""
    values, truth = TAKES[take]
    motions = int(truth.max()) + 1
    plain = plain_mixture(gmm.leading_dimensions(values), truth, motions)
    assert same_grouping(gmm.label_by_mixture(values, motions, 0), plain)


def plain_hidden_markov(values, stride, half, seconds, motions):
    """Densities compared pose by pose, and the path found by going through all states at every step."""
    sampled = values[stride // 2 :: stride]
    count = len(sampled)
    near = np.array([sorted(np.linalg.norm(sampled - x, axis=1))[: max(int(NEAREST * count), 2)] for x in sampled])
    kernel = [[np.exp(-np.sum((x - y) ** 2) / (2 * near.mean() ** 2)) for y in sampled] for x in sampled]
    windows = [range(max(i - half, 0), min(i + half + 1, count)) for i in range(count)]
    shared = np.array([[np.mean([kernel[i][j] for i in a for j in b]) for b in windows] for a in windows])
    apart = np.add.outer(np.diag(shared), np.diag(shared)) - 2 * shared
    change = hidden_markov.CHANGE_SECONDS / seconds * apart.mean()
    while True:
        cost, paths = apart[0].copy(), [[s] for s in range(count)]
        for t in range(1, count):
            best = int(np.argmin(cost))
            leave = cost > cost[best] + change
            paths = [[*(paths[best] if leave[s] else paths[s]), s] for s in range(count)]
            cost = np.where(leave, cost[best] + change, cost) + apart[t]
        path = np.array(paths[int(np.argmin(cost))])
        if len(set(path.tolist())) >= motions:
            break
        change /= 2
    used, place = np.unique(path, return_inverse=True)
    pairs = np.sqrt(np.maximum([apart[a, b] for a, b in itertools.combinations(used, 2)], 0))
    labels = fcluster(linkage(pairs, "average"), motions, "maxclust")[place]
    return np.repeat(labels, stride)[: len(values)]


@each
def test_the_hidden_markov_model_is_the_plain_one(take):
    """The same labels, of a take of few samples."""
    values, truth = TAKES[take]
    values, truth = values[::6], truth[::6]  # five a second
    rate, motions = RATE / 6, int(truth.max()) + 1
    half = round(hidden_markov.WINDOW_SECONDS * rate / 2)
    plain = plain_hidden_markov(values, 1, half, 1 / rate, motions)
    assert same_grouping(hidden_markov._label_frames(values, rate, motions, 0), plain)


def plain_minima(values, smooth, half):
    """Every frame asked one by one."""
    change = [float(np.sum((b - a) ** 2)) for a, b in itertools.pairwise(values)]
    last = len(change) - 1
    speed = [
        np.mean([change[min(max(i + j - smooth // 2, 0), last)] for j in range(smooth)]) for i in range(len(change))
    ]
    bounds = [0]
    for i, own in enumerate(speed):
        lowest = own <= min(speed[max(i - half, 0) : i + half + 1]) + 1e-12
        frame = i + 1
        inside = half <= frame <= len(values) - half and frame - bounds[-1] > half
        if lowest and own < velocity_minima.SLOW * np.mean(speed) and inside:
            bounds.append(frame)
    return [*bounds, len(values)]


@each
def test_minima_of_velocity_are_those_of_every_frame_asked(take):
    """And there are some."""
    values, _ = TAKES[take]
    swings = np.sin(np.arange(len(values)) / 11.0)[:, None] * values
    found = velocity_minima.find_velocity_minima(swings, RATE).tolist()
    assert found == plain_minima(swings, round(0.2 * RATE), round(0.3 * RATE))
    assert len(found) > 4


def plain_error(values, keys):
    """Frames blended one by one."""
    error = 0.0
    for a, b in itertools.pairwise(keys):
        for f in range(a + 1, b):
            share = (f - a) / (b - a)
            error += np.sum((values[f] - (1 - share) * values[a] - share * values[b]) ** 2)
    return error


@each
def test_no_key_frames_have_less_error_than_those_that_are_bred(take):
    """Eighteen frames, every choice of six key-frames; and the error is that of frames blended one by one."""
    values = TAKES[take][0][::13][:18]
    keys = breed_key_frames(values, 6, seed=1)
    choices = ([0, *inner, len(values) - 1] for inner in itertools.combinations(range(1, len(values) - 1), 4))
    least = min(plain_error(values, keys) for keys in choices)
    assert plain_error(values, keys.tolist()) == pytest.approx(least, rel=1e-9)
    assert float(ReconstructionError.of(values).of_keys(keys)) == pytest.approx(least, rel=1e-6)


def plain_simplification(values, count):
    """At each step all frames are asked how far they are from the lines drawn so far."""
    keys = [0, len(values) - 1]
    while len(keys) < count:
        strays = {}
        for a, b in itertools.pairwise(sorted(keys)):
            for f in range(a + 1, b):
                line = values[a] + (f - a) / (b - a) * (values[b] - values[a])
                strays[f] = np.sum((values[f] - line) ** 2)
        if not strays or max(strays.values()) == 0:
            break
        keys.append(max(strays, key=lambda f: strays[f]))
    return sorted(keys)


@each
def test_curves_are_simplified_as_by_asking_every_frame_at_every_step(take):
    """To the frame; and where lines meet every frame, there are fewer key-frames."""
    values, _ = TAKES[take]
    assert simplify(values, 15).tolist() == plain_simplification(values, 15)
    assert simplify(np.arange(20.0)[:, None], 15).tolist() == [0, 19]


@each
def test_segments_are_described_by_mean_and_deviation_and_grouped(take):
    """As NumPy has them; told the true segments, the groups are the true motions."""
    values, truth = TAKES[take]
    bounds = np.array([0, *(np.flatnonzero(np.diff(truth)) + 1), len(truth)])
    plain = [np.concatenate([values[a:b].mean(axis=0), values[a:b].std(axis=0)]) for a, b in itertools.pairwise(bounds)]
    found = describe_segments(values, bounds)
    np.testing.assert_allclose(found, plain - np.pad(values.mean(axis=0), (0, values.shape[1])), atol=1e-9)
    assert same_grouping(label_segments(values, bounds, int(truth.max()) + 1, 0), truth)


def test_a_frame_is_of_the_motion_of_the_key_frame_that_counts_most_in_it():
    """Of two that count alike, the earlier."""
    labels = label_by_nearest_key(np.array([0, 4, 9]), np.array([2, 1, 2]), 10)
    assert labels.tolist() == [2, 2, 2, 1, 1, 1, 1, 2, 2, 2]
