"""A look at a few frames before the pass over all: how far coordinates go, and how large strain gets."""

from dataclasses import dataclass

import numpy as np

from core.animation import Animation
from core.descriptors.projection import sample_frames
from core.drawing import draw_frames, largest_coordinate
from core.surfaces import Surface

FRAMES = 32
LEAST_FRAMES = 8
SHARE = 40
"""One frame in so many is looked at, within these bounds, for each costs as much as any other."""
AT_ONCE = 8
THINNED = 8
COMMON = 0.98


@dataclass(frozen=True)
class Glance:
    """The largest |coordinate| and the largest strain of the frames looked at, and what 98 % of it stay below."""

    reach: float
    strain: float
    common: float

    @classmethod
    def at(cls, animation: Animation, surface: Surface) -> "Glance":
        """8 to 32 frames, evenly spaced; `common` is from every 8th column."""
        reach = strain = 0.0
        thinned: list[np.ndarray] = []
        frames = sample_frames(animation.frames, min(max(animation.frames // SHARE, LEAST_FRAMES), FRAMES))
        for start in range(0, len(frames), AT_ONCE):
            vertices = draw_frames(animation, frames[start : start + AT_ONCE])
            reach = max(reach, largest_coordinate(vertices))
            for _, tile in surface.tiles(vertices):
                strain = max(strain, float(tile.max(initial=0)))
                thinned.append(tile[::THINNED].ravel())
        values = np.concatenate([*thinned, np.zeros(1, np.float32)])
        return cls(reach, strain, float(np.quantile(values, COMMON)))
