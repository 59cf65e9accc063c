"""The neighbour graph: of several labellings the true one cuts the fewest links."""

import numpy as np
import pytest

from caesura.core.methods.switching.neighbour_graph import NeighbourGraph

RATE = 30.0


def swings(periods, seconds=12.0):
    """A take of swings about one pose after the other, each of its own period."""
    time = np.arange(round(seconds * RATE)) / RATE
    parts = [
        np.stack([3 * i + np.sin(2 * np.pi * time / period), np.cos(2 * np.pi * time / period)], axis=1)
        for i, period in enumerate(periods)
    ]
    return np.concatenate(parts).astype(np.float32)


def test_the_true_labels_are_cut_least():
    """Moved cuts, halves and joined motions cost more; names do not matter."""
    graph = NeighbourGraph.of(swings([1.0, 1.3, 0.8]), RATE)
    truth = np.repeat([0, 1, 2], 360)
    assert graph.cut(truth) == pytest.approx(graph.cut(2 - truth))
    assert graph.cut(truth) < graph.cut(np.roll(truth, 60))
    assert graph.cut(truth) < graph.cut(np.where(np.arange(1080) < 180, 0, np.where(truth == 0, 1, 2)))
    assert graph.cut(truth * 0) == 0


def test_the_phases_of_a_slow_swing_belong_together():
    """Left and right of a twist of three seconds are unlike, but follow each other: to part them is dear."""
    poses = swings([3.0, 1.1])
    phases = np.where(np.arange(720) < 360, (poses[:, 0] > 0).astype(np.int64), 2)
    graph = NeighbourGraph.of(poses, RATE)
    assert graph.cut(phases) - graph.cut(np.repeat([0, 1], 360)) > 0.35


def performed_once(period):
    """Four motions of three seconds, each in its own directions and performed once."""
    random, time = np.random.default_rng(0), np.arange(round(3 * RATE)) / RATE
    angle = 2 * np.pi * time[:, None] / period
    poses, cosines, sines = random.normal(0, 1, (3, 4, 8))
    parts = [1.5 * p + np.sin(angle) * s + np.cos(angle) * c for p, s, c in zip(poses, sines, cosines, strict=True)]
    return np.concatenate(parts).astype(np.float32), np.repeat(np.arange(4), len(time))


@pytest.mark.parametrize("period", [1.3, 1.6, 2.9])
def test_a_motion_performed_once_is_like_no_other(period):
    """Its moments have neighbours elsewhere, which are not like it, and repetitions hardly more than a second away."""
    poses, truth = performed_once(period)
    assert NeighbourGraph.of(poses, RATE).cut(truth) < 1.4


@pytest.mark.parametrize("frames", [1, 2, 5, 30])
def test_the_shortest_takes_have_a_graph(frames):
    """Even where no two moments are far enough apart to be linked."""
    assert NeighbourGraph.of(swings([1.0])[:frames], RATE).cut(np.zeros(frames, np.int64)) == 0
