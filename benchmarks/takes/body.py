"""A body around a captured skeleton: one smooth surface, and weights that bend it the way flesh gives."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from benchmarks.takes.acclaim import Acclaim
from caesura.samples.implicit_surface import Limb, Surface, polygonise_limbs
from caesura.samples.skin_weights import heat_weights

CELL = 0.0315  # metres: about 5,700 triangles
SHARPNESS = 0.4  # flesh gives over somewhat more than the thickness of the limb

# Bone, then two ends: the share of the way along the bone, metres from there, the radius there. Limbs come in pairs.
Form = tuple[str, float, tuple[float, float, float], float, float, tuple[float, float, float], float]
TRUNK: tuple[Form, ...] = (
    ("root", 0, (-0.075, -0.04, -0.01), 0.105, 0, (0.075, -0.04, -0.01), 0.105),
    ("lowerback", 0.6, (-0.05, 0, 0.005), 0.1, 0.6, (0.05, 0, 0.005), 0.1),
    ("upperback", 0.7, (-0.06, 0, 0.01), 0.103, 0.7, (0.06, 0, 0.01), 0.103),
    ("thorax", 0.35, (-0.085, 0, 0.01), 0.105, 0.35, (0.085, 0, 0.01), 0.105),
    ("thorax", 0.9, (-0.1, 0, -0.01), 0.075, 0.9, (0.1, 0, -0.01), 0.075),
    ("lowerneck", 0.0, (0, 0, 0), 0.06, 1, (0, 0, 0.01), 0.055),
    ("upperneck", 0.0, (0, 0, 0.01), 0.055, 1, (0, 0, 0.02), 0.056),
    ("head", 0.6, (0, 0, 0.015), 0.088, 1, (0, 0, 0.02), 0.09),
    ("head", 0.1, (0, 0, 0.05), 0.055, 0.7, (0, 0, 0.05), 0.065),
)
LIMBS: tuple[Form, ...] = (
    ("clavicle", 0.25, (0, 0, -0.01), 0.055, 0.85, (0, 0, 0), 0.058),
    ("humerus", 0.0, (0, 0, 0), 0.06, 0.35, (0, 0, 0), 0.054),
    ("humerus", 0.35, (0, 0, 0), 0.054, 1, (0, 0, 0), 0.041),
    ("radius", 0.0, (0, 0, 0), 0.041, 0.4, (0, 0, 0), 0.045),
    ("radius", 0.4, (0, 0, 0), 0.045, 1, (0, 0, 0), 0.034),
    ("wrist", 0.0, (0, 0, 0), 0.034, 1, (0, 0, 0), 0.029),
    ("hand", 0.0, (0, 0, 0), 0.029, 1, (0, 0, 0), 0.035),
    ("fingers", 0.0, (0, 0, -0.01), 0.03, 1.6, (0, 0, -0.008), 0.02),
    ("fingers", 0.0, (0, 0, 0.012), 0.028, 1.6, (0, 0, 0.012), 0.02),
    ("thumb", 0.0, (0, 0, 0.005), 0.02, 1.2, (0, 0, 0), 0.016),
    ("femur", 0.02, (0, 0, -0.01), 0.097, 0.3, (0, 0, 0.005), 0.09),
    ("femur", 0.3, (0, 0, 0.005), 0.09, 1, (0, 0, 0), 0.056),
    ("tibia", 0.0, (0, 0, 0), 0.055, 0.3, (0, 0, -0.015), 0.058),
    ("tibia", 0.3, (0, 0, -0.015), 0.058, 1, (0, 0, 0), 0.037),
    ("foot", 0.0, (0, -0.02, -0.035), 0.04, 1, (0, 0, 0), 0.036),
    ("foot", 0.0, (0, 0, 0), 0.038, 1, (0, 0, 0), 0.038),
    ("toes", 0.0, (-0.014, 0, 0), 0.033, 1, (-0.012, 0, 0), 0.025),
    ("toes", 0.0, (0.016, 0, 0), 0.032, 0.9, (0.012, 0, 0), 0.024),
)


@dataclass(frozen=True)
class Body:
    """A surface at rest and how much each bone moves each vertex; the weights of a vertex sum to 1."""

    surface: Surface
    weights: Float[np.ndarray, "V bones"]
    origins: Float[np.ndarray, "bones 3"]  # the bones' starts at rest

    @property
    def triangles(self) -> Int[np.ndarray, "T 3"]:
        """The triangulation, the same in all frames."""
        return self.surface.triangles

    def posed(
        self, rotations: Float[np.ndarray, "frames bones 3 3"], starts: Float[np.ndarray, "frames bones 3"]
    ) -> Float[np.ndarray, "frames V 3"]:
        """Linear blend skinning: Σ_b w_b (R_b (v - o_b) + s_b), as one product; float32."""
        moved = starts - (rotations @ self.origins[:, :, None])[..., 0]
        transforms = np.concatenate([rotations, moved[..., None]], axis=3)  # frames, bones, 3, 4
        frames, bones = transforms.shape[:2]
        points = np.concatenate([self.surface.vertices, np.ones((len(self.weights), 1))], axis=1)
        spread = (self.weights[:, :, None] * points[:, None, :]).reshape(len(points), bones * 4)
        flat = transforms.transpose(1, 3, 0, 2).reshape(bones * 4, frames * 3)
        vertices = (spread @ flat).reshape(len(points), frames, 3)
        return np.ascontiguousarray(vertices.transpose(1, 0, 2), dtype=np.float32)


def body(skeleton: Acclaim, sharpness: float = SHARPNESS) -> Body:
    """The body of a CMU skeleton at rest, arms out, legs a little apart; `sharpness` as in `heat_weights`."""
    _, starts = skeleton.pose({}, 1)
    forms = limbs(skeleton, starts[0])
    surface = polygonise_limbs(forms, CELL)
    return Body(surface, heat_weights(surface, forms, len(skeleton.bones), sharpness), starts[0])


def limbs(skeleton: Acclaim, starts: Float[np.ndarray, "bones 3"]) -> list[Limb]:
    """The round cones of the body at rest, each owned by the bone that moves it."""
    rows = [(row, "", 1.0) for row in TRUNK]
    rows += [(row, side, mirror) for side, mirror in (("l", 1.0), ("r", -1.0)) for row in LIMBS]
    made = []
    for (name, share, offset, radius, far_share, far_offset, far_radius), side, mirror in rows:
        number = skeleton.index(side + name)
        along = skeleton.bones[number].vector
        mirrored = np.array([mirror, 1.0, 1.0])
        start = starts[number] + share * along + mirrored * offset
        end = starts[number] + far_share * along + mirrored * far_offset
        made.append(Limb(number, start, end, radius, far_radius))
    return made
