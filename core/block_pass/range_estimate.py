"""A look at a few frames before the pass over all: how far coordinates go, and how large strain gets."""

from dataclasses import dataclass

import numpy as np

from caesura.core.animation import Animation
from caesura.core.block_pass.projection import choose_sample_frames
from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.descriptors.table import Descriptor
from caesura.core.frames.sampled_frames import largest_coordinate, read_sampled_frames

FRAMES = 32
LEAST_FRAMES = 8
SHARE = 40
"""One frame in so many is looked at, within these bounds, for each costs as much as any other."""
TRIANGLES = 512
"""As many triangles are looked at; what they miss shows in the pass over all, which is then made again."""
THINNED = 4
COMMON = 0.98
AT_ONCE_BYTES = 32 * 2**20


@dataclass(frozen=True)
class RangeEstimate:
    """The largest |coordinate| and the largest strain of the frames looked at, and what 98 % of it stay below."""

    reach: float
    strain: float
    common: float

    @classmethod
    def at(cls, animation: Animation, surface: Descriptor) -> "RangeEstimate":
        """8 to 32 frames, evenly spaced, on about 500 triangles all over; `common` is from every 4th of those."""
        frames = choose_sample_frames(animation.frames, min(max(animation.frames // SHARE, LEAST_FRAMES), FRAMES))
        looked = surface.thinned(TRIANGLES) if isinstance(surface, TriangleStrain) else surface
        at_once = max(AT_ONCE_BYTES // (12 * max(animation.vertex_count, 1)), 1)
        reach, strain, thinned = 0.0, 0.0, [np.zeros(1, np.float32)]
        for start in range(0, len(frames), at_once):
            vertices = read_sampled_frames(animation, frames[start : start + at_once])
            reach = max(reach, largest_coordinate(vertices))
            for _, tile in looked.tiles(vertices):
                strain = max(strain, float(tile.max(initial=0)))
                thinned.append(tile[::THINNED].ravel())
        every = np.concatenate(thinned)
        place = int(COMMON * (len(every) - 1))
        return cls(reach, strain, float(np.partition(every, place)[place]))
