"""Subdivision: a motion seen by itself may be two.

Three small motions beside a large one are one motion in every view of the whole take, for their differences are nothing
beside the large one. With that out of sight they are seen.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Int

from caesura.core.methods.switching.views import BOTH, View, Views

LEAST_WINDOWS = 2
"""A motion that lasts less than so many windows in all is not divided."""


def subdivide_motions(
    labels: Int[np.ndarray, "frames"], views: Views
) -> Iterator[tuple[View, Int[np.ndarray, "frames"]]]:
    """For every view that weighs the descriptors alike and every motion: the labels with that motion cut into two."""
    for view in (view for view in views.names if view.weights == BOTH):
        signal = views.by(view).signal
        count = len(signal.values)
        of_step = labels[np.minimum(np.arange(count) * signal.stride + signal.stride // 2, len(labels) - 1)]
        for motion in np.unique(of_step).tolist():
            steps = np.flatnonzero(of_step == motion)
            alone = views.within(view, steps) if len(steps) >= LEAST_WINDOWS * signal.window else None
            halves = alone.settled(2) if alone is not None else None
            if halves is not None and halves.motions == 2:
                divided = of_step.copy()
                divided[steps[halves.labels == 1]] = of_step.max() + 1
                yield view, signal.per_frame(divided)
