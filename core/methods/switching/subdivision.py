"""Subdivision: a motion seen by itself may be two.

Three small motions beside a large one are one motion in every view of the whole take, for their differences are nothing
beside the large one. With that out of sight they are seen.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Bool, Int

from caesura.core.frames.blocks import map_blocks
from caesura.core.methods.switching.views import BOTH, View, Views

LEAST_WINDOWS = 2
"""A motion that lasts less than so many windows in all is not divided."""


def subdivide_motions(
    labels: Int[np.ndarray, "frames"], views: Views, threads: int = 1
) -> Iterator[tuple[View, Int[np.ndarray, "frames"]]]:
    """For every view that weighs the descriptors alike and every motion: the labels with that motion cut into two."""
    tasks = [
        (view, of_step, motion)
        for view, of_step in _labels_in_views(labels, views)
        for motion in np.unique(of_step).tolist()
    ]
    yield from (found for found in map_blocks(lambda task: _divide(views, *task), tasks, threads) if found is not None)


def _labels_in_views(
    labels: Int[np.ndarray, "frames"], views: Views
) -> Iterator[tuple[View, Int[np.ndarray, "steps"]]]:
    for view in (view for view in views.names if view.weights == BOTH):
        signal = views.by(view).signal
        middles = np.arange(len(signal.values)) * signal.stride + signal.stride // 2
        yield view, labels[np.minimum(middles, len(labels) - 1)]


def _divide(
    views: Views, view: View, of_step: Int[np.ndarray, "steps"], motion: int
) -> tuple[View, Int[np.ndarray, "frames"]] | None:
    """The labels with one motion cut into two; None where it is short, or where no half lasts a window anywhere."""
    signal, steps = views.by(view).signal, np.flatnonzero(of_step == motion)
    alone = views.within(view, steps) if len(steps) >= LEAST_WINDOWS * signal.window else None
    halves = alone.settled(2) if alone is not None else None
    if halves is None or halves.motions != 2:
        return None
    second = halves.labels == 1
    for performed in np.split(second, np.flatnonzero(np.diff(steps) > 1) + 1):
        _merge_short_pieces(performed, signal.window)
    if second.all() or not second.any():
        return None
    divided = of_step.copy()
    divided[steps[second]] = of_step.max() + 1
    return view, signal.per_frame(divided)


def _merge_short_pieces(second: Bool[np.ndarray, "steps"], least: int) -> None:
    """In one segment of the motion, what is shorter than `least` joins the other half, the shortest first."""
    while True:
        bounds = np.concatenate([[0], np.flatnonzero(np.diff(second)) + 1, [len(second)]])
        lengths = np.diff(bounds)
        shortest = int(lengths.argmin())
        if len(lengths) == 1 or lengths[shortest] >= least:
            return
        second[bounds[shortest] : bounds[shortest + 1]] ^= True
