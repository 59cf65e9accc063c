"""A face of our own that makes expressions: a stand-in for captured faces, which their owners alone may pass on.

A mask of some 1,250 triangles in front of the skull, and muscles that each move the skin around one place. An
expression is how hard each muscle pulls. As in the recordings of the paper three raised eyebrows come first, then
anger, disgust, fear, happiness, surprise and sadness, each from the neutral face and back to it.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32, Int

RATE = 30.0
POINTS = 26
"""Along either side of the mask."""

# Place of a muscle on the mask (x to the right, y up), the radius it moves, and where it pulls (right, up, forward).
MUSCLES = {
    "left brow": ((-0.4, 0.4), 0.2, (0.0, 0.1, 0.02)),
    "right brow": ((0.4, 0.4), 0.2, (0.0, 0.1, 0.02)),
    "inner brows": ((0.0, 0.4), 0.16, (0.0, 0.08, 0.03)),
    "frown": ((0.0, 0.3), 0.2, (0.0, -0.08, 0.03)),
    "nose": ((0.0, 0.05), 0.14, (0.0, 0.07, 0.02)),
    "upper lip": ((0.0, -0.3), 0.14, (0.0, 0.08, 0.03)),
    "left corner": ((-0.3, -0.42), 0.16, (-0.1, 0.0, -0.03)),
    "right corner": ((0.3, -0.42), 0.16, (0.1, 0.0, -0.03)),
    "left cheek": ((-0.42, -0.1), 0.18, (0.0, 0.08, 0.04)),
    "right cheek": ((0.42, -0.1), 0.18, (0.0, 0.08, 0.04)),
    "corners up": ((0.0, -0.42), 0.34, (0.0, 0.06, 0.0)),
    "jaw": ((0.0, -0.75), 0.34, (0.0, -0.22, -0.03)),
}
EXPRESSIONS = {
    "eyebrow-raising": {"left brow": 1, "right brow": 1, "inner brows": 0.7},
    "anger": {"frown": 1.2, "upper lip": -0.5, "left brow": -0.5, "right brow": -0.5},
    "disgust": {"nose": 1.2, "upper lip": 1.2, "left cheek": 0.4, "right cheek": 0.4},
    "fear": {"inner brows": 1.2, "left corner": 1, "right corner": 1, "jaw": 0.3},
    "happiness": {"left corner": 1, "right corner": 1, "left cheek": 1, "right cheek": 1, "corners up": 0.6},
    "surprise": {"left brow": 1.2, "right brow": 1.2, "inner brows": 1, "jaw": 1.2},
    "sadness": {"inner brows": 1.3, "corners up": -1.2, "frown": 0.3},
}
ORDER = ("eyebrow-raising",) * 3 + ("anger", "disgust", "fear", "happiness", "surprise", "sadness")
HELD = 0.45
"""Share of the time from one expression to the next in which the face is neutral."""
TREMBLE = 2e-4
"""Of the skin, from frame to frame, as a scanner has it."""


@dataclass(frozen=True)
class FaceTake:
    """`vertices` (frames, V, 3) in half heads, turning a little; `labels` the expression nearest to each frame."""

    vertices: Float32[np.ndarray, "frames V 3"]
    triangles: Int[np.ndarray, "T 3"]
    rest: Float32[np.ndarray, "V 3"]
    labels: Int[np.ndarray, "frames"]
    """0, 0, 0, 1, …: which of `EXPRESSIONS` is nearest in time."""
    peaks: tuple[int, ...]
    """The frame at which each of the nine is strongest."""


def build_face(frames: int = 1063, seed: int = 0) -> FaceTake:
    """Nine expressions over so many frames, 30 a second; the same for the same seed."""
    random = np.random.default_rng(seed)
    rest, triangles = _mask()
    length = frames / len(ORDER)
    time = np.arange(frames)
    vertices = np.repeat(rest[None], frames, axis=0)
    for place, name in enumerate(ORDER):
        strength = random.uniform(0.9, 1.1)
        near = np.clip(1 - np.abs(time - (place + 0.5) * length) / (length * (1 - HELD) / 2), 0, 1)
        pull = strength * np.sin(near * np.pi / 2) ** 2
        vertices += pull[:, None, None] * _displacement(rest, EXPRESSIONS[name])
    vertices += TREMBLE * random.normal(size=vertices.shape)
    turn = 0.05 * np.sin(time / 40)
    cos, sin = np.cos(turn)[:, None], np.sin(turn)[:, None]
    x, z = vertices[:, :, 0].copy(), vertices[:, :, 2].copy()
    vertices[:, :, 0], vertices[:, :, 2] = cos * x + sin * z, cos * z - sin * x
    which = np.minimum((time / length).astype(np.int64), len(ORDER) - 1)
    numbers = np.array([list(EXPRESSIONS).index(name) for name in ORDER])
    peaks = tuple(round((place + 0.5) * length) for place in range(len(ORDER)))
    return FaceTake(vertices.astype(np.float32), triangles, rest.astype(np.float32), numbers[which], peaks)


def _mask() -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]:
    """An oval shell with a nose, and its triangles."""
    across, up = np.meshgrid(np.linspace(-0.8, 0.8, POINTS), np.linspace(-1, 0.9, POINTS), indexing="ij")
    x, y = across * np.sqrt(1 - (up / 1.6) ** 2), up
    nose = 0.18 * np.exp(-((x / 0.12) ** 2) - ((y + 0.02) / 0.25) ** 2)
    z = np.sqrt(np.maximum(1.2 - x**2 - 0.5 * y**2, 0)) + nose
    corner = (np.arange(POINTS - 1)[:, None] * POINTS + np.arange(POINTS - 1)).reshape(-1, 1)
    triangles = np.concatenate([corner + np.array(ends) for ends in ([0, POINTS, 1], [1, POINTS, POINTS + 1])])
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), triangles.astype(np.int64)


def _displacement(rest: Float[np.ndarray, "V 3"], pulls: dict[str, float]) -> Float[np.ndarray, "V 3"]:
    moved = np.zeros_like(rest)
    for name, pull in pulls.items():
        place, radius, direction = MUSCLES[name]
        near = np.exp(-np.square(rest[:, :2] - place).sum(axis=1) / (2 * radius**2))
        moved += pull * near[:, None] * np.array(direction)
    return moved
