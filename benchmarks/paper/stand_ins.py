"""Takes of our own making in place of those of Table 1, which were never published.

A face that morphs for 'Face1' and 'Face2'; the sample figure, doing two squats and four jumps, for 'Exercise'; a
made-up creature, one of whose motions returns, for 'Squirrel'.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from benchmarks.takes.creatures import creature
from benchmarks.takes.joining import joined
from caesura.api import open_animation
from caesura.core.animation import Animation
from caesura.core.parameters import Parameters
from caesura.samples.figure_glb import smooth_glb
from caesura.samples.morphing_face import build_face
from caesura.samples.performed_take import RATE, Part, perform_take
from caesura.samples.repertoire import MOTIONS
from caesura.samples.smooth_body import build_body

CREATURE = 33


@dataclass(frozen=True)
class StandIn:
    """A take, its motions, the settings that the paper gives its own, and the paper's row of Table 1.

    `window` and `keyframe_window` in seconds. `published`: triangles, frames and seconds of the paper's take.
    """

    name: str
    animation: Animation
    truth: Int[np.ndarray, "frames"]
    window: float
    keyframe_window: float
    published: tuple[int, int, float]

    def parameters(self, method: str = "joint-entropy") -> Parameters:
        """The paper's settings, K given."""
        return Parameters(
            method=method,
            motions=len(np.unique(self.truth)),
            window_seconds=self.window,
            keyframe_window_seconds=self.keyframe_window,
            rest=0,
            descriptors="strain",
            details=True,
        )


def stand_ins() -> Iterator[StandIn]:
    """The four of them."""
    for name, frames, window, seconds, triangles in (("Face1", 1063, 1.0, 1.8, 1272), ("Face2", 1472, 1.5, 3.0, 1171)):
        face = build_face(frames, seed=int(name[-1]))
        animation = open_animation(face.vertices, face.triangles, frame_rate=30.0, rest_shape=face.rest)
        yield StandIn(name, animation, face.labels, window, 2.0, (triangles, frames, seconds))
    yield exercise()
    made = joined("creature.glb", creature(CREATURE, 3), 3, CREATURE)
    every = slice(0, made.animation.frames, 10)
    vertices = made.animation.vertices(0, made.animation.frames)[every]
    slow = open_animation(vertices, made.animation.triangles, frame_rate=3.0)
    yield StandIn("Squirrel", slow, made.truth[every], 1.3, 2.7, (7646, 103, 0.6))


def exercise() -> StandIn:
    """Two squats and four jumps at five frames a second; l of four seconds, as the paper has it."""
    random = np.random.default_rng(5)
    parts = [
        Part(MOTIONS[name], MOTIONS[name].ends(times, RATE, random)) for name, times in (("squat", 2), ("jump", 4))
    ]
    take = perform_take(parts, random)
    animation = open_animation(smooth_glb(build_body(), take), fps=5)
    ends = [round(end * 5 / RATE) for _, _, end in take.truth.segments]
    truth = np.repeat([0, 1], np.diff([0, ends[0], animation.frames]))
    return StandIn("Exercise", animation, truth, 4.0, 2.0, (29_999, 54, 14.3))
