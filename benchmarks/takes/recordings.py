"""The same take as another recording would have it: its rate, side, units and noise, and what is seen of the body."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from caesura.api import open_animation
from caesura.core.analysis import Analysis
from caesura.core.mesh.farthest_points import sample_farthest_points
from caesura.core.pipeline import analyse

NOISE = 0.0003
"""Of the size of the body."""
MARKERS = 41
TURN = np.array([[0.6, 0.0, 0.8], [0.48, 0.8, -0.36], [-0.64, 0.6, 0.48]])
"""A rotation about no axis of the file's own."""


@dataclass(frozen=True)
class Recording:
    """What is seen of a body: points over time, and the triangles between them where it has a surface."""

    vertices: Float[np.ndarray, "frames V 3"]
    triangles: Int[np.ndarray, "T 3"] | None
    frame_rate: float

    def analysis(self) -> Analysis:
        """The analysed points."""
        vertices = self.vertices.astype(np.float32)
        return analyse(open_animation(vertices, self.triangles, frame_rate=self.frame_rate))

    def moved(self, vertices: Float[np.ndarray, "frames V 3"]) -> "Recording":
        """The same points elsewhere."""
        return replace(self, vertices=vertices)


def recorded_otherwise() -> dict[str, Callable[[Recording], Recording]]:
    """Other recordings of one take, by what is different."""
    return {
        **{f"{rate:g} frames a second": _at(rate) for rate in (24.0, 30.0, 60.0, 120.0)},
        "mirrored": lambda take: take.moved(take.vertices * [-1, 1, 1]),
        "turned": lambda take: take.moved(take.vertices @ TURN),
        "in centimetres": lambda take: take.moved(take.vertices * 100),
        "noise of 0.0003": _noisy,
        "a second of rest": lambda take: take.moved(
            np.pad(take.vertices, ((int(take.frame_rate),) * 2, (0, 0), (0, 0)), "edge")
        ),
        "backwards": lambda take: take.moved(take.vertices[::-1]),
        "as markers": as_markers,
    }


def as_markers(take: Recording) -> Recording:
    """Some forty points spread over the body, without a surface, as cameras see them."""
    chosen = sample_farthest_points(take.vertices[0], MARKERS, np.ones(take.vertices.shape[1], bool)).chosen
    return Recording(take.vertices[:, np.sort(chosen)], None, take.frame_rate)


def _at(rate: float) -> Callable[[Recording], Recording]:
    def resampled(take: Recording) -> Recording:
        vertices, of = take.vertices, take.frame_rate
        place = np.arange(int((len(vertices) - 1) / of * rate) + 1) * of / rate
        below = np.minimum(place.astype(np.int64), len(vertices) - 2)
        share = (place - below)[:, None, None]
        return Recording(vertices[below] * (1 - share) + vertices[below + 1] * share, take.triangles, rate)

    return resampled


def _noisy(take: Recording) -> Recording:
    size = float(np.linalg.norm(np.ptp(take.vertices[0], axis=0)))
    return take.moved(take.vertices + np.random.default_rng(1).normal(0, NOISE * size, take.vertices.shape))
