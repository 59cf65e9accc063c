"""A look at a few frames before the pass over all: how far coordinates go, and how large strain gets."""

from dataclasses import dataclass

from core.animation import Animation
from core.descriptors.projection import sample_frames
from core.drawing import draw_frames, largest_coordinate
from core.surfaces import Surface

FRAMES = 64
AT_ONCE = 8


@dataclass(frozen=True)
class Glance:
    """The largest |coordinate| and the largest strain of the frames looked at."""

    reach: float
    strain: float

    @classmethod
    def at(cls, animation: Animation, surface: Surface) -> "Glance":
        """At most 64 frames, evenly spaced."""
        reach = strain = 0.0
        frames = sample_frames(animation.frames, FRAMES)
        for start in range(0, len(frames), AT_ONCE):
            vertices = draw_frames(animation, frames[start : start + AT_ONCE])
            reach = max(reach, largest_coordinate(vertices))
            for _, tile in surface.tiles(vertices):
                strain = max(strain, float(tile.max(initial=0)))
        return cls(reach, strain)
