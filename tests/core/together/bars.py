"""Takes of a bar that bends, sways, stretches and swells, as a collection sees them."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from caesura.core.together.body_poses import measure_poses
from caesura.core.together.measured_take import MeasuredTake
from tests.animations import animation, performing_bar, turned

SECONDS = 4.0


def bar_take(name, order, *, size=1.0, angle=0.0, rate=30.0):
    """The bar doing these motions in turn, of another size, turned and elsewhere, with its true segments."""
    made = performing_bar(order, seconds=SECONDS, rate=rate, rings=12)
    held = np.array(made.animation.vertices(0, made.animation.frames), np.float64)
    moved = turned(size * held.reshape(-1, 3), angle).reshape(held.shape) + 3 * size
    other = animation(moved, made.animation.triangles, rate=rate)
    bounds = np.array([0, *(np.flatnonzero(np.diff(made.truth)) + 1), len(made.truth)])
    numbers = {motion: i for i, motion in enumerate(dict.fromkeys(order))}
    own = np.array([numbers[int(made.truth[start])] for start, _ in pairwise(bounds)])
    return MeasuredTake(name, measure_poses(other), bounds, own, np.full(len(own), 4))


def truths(*orders):
    """The true motion of every segment of takes in these orders."""
    return np.concatenate([np.array(order) for order in orders])


def renamed(take, name):
    """The same take under another name."""
    return replace(take, name=name)
