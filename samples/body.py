"""The smooth figure's body: one welded surface around the skeleton, bound to it by smooth weights."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.samples.skeleton import BIND, HUMAN
from caesura.samples.surface import Limb, Surface, skin
from caesura.samples.weights import heat_weights, strongest

CELL = 0.03  # metres: about 6,000 triangles
SHARPNESS = 0.4

# Joint, from, to, radius there and there: metres, from the joint, in the straight stance. Limbs come in pairs.
Form = tuple[str, tuple[float, float, float], tuple[float, float, float], float, float]
FORMS: tuple[Form, ...] = (
    ("hips", (-0.075, -0.03, -0.01), (0.075, -0.03, -0.01), 0.105, 0.105),
    ("hips", (-0.055, 0.06, 0.0), (0.055, 0.06, 0.0), 0.098, 0.098),
    ("spine", (-0.05, 0.06, 0.0), (0.05, 0.06, 0.0), 0.098, 0.098),
    ("chest", (-0.07, -0.01, 0.01), (0.07, -0.01, 0.01), 0.105, 0.105),
    ("chest", (-0.085, 0.09, 0.012), (0.085, 0.09, 0.012), 0.105, 0.105),
    ("chest", (-0.105, 0.15, -0.005), (0.105, 0.15, -0.005), 0.07, 0.07),
    ("neck", (0.0, -0.04, 0.0), (0.0, 0.09, 0.015), 0.062, 0.054),
    ("head", (0.0, 0.1, -0.005), (0.0, 0.13, 0.0), 0.09, 0.092),
    ("head", (0.0, 0.03, 0.035), (0.0, 0.08, 0.04), 0.055, 0.068),
)
PAIRS: tuple[Form, ...] = (
    ("clavicle", (0.03, 0.0, -0.01), (0.12, 0.0, -0.01), 0.05, 0.055),
    ("upper_arm", (0.0, 0.0, 0.0), (0.0, -0.1, 0.0), 0.062, 0.054),
    ("upper_arm", (0.0, -0.1, 0.003), (0.0, -0.285, 0.0), 0.054, 0.041),
    ("forearm", (0.0, 0.0, 0.0), (0.0, -0.08, 0.0), 0.041, 0.045),
    ("forearm", (0.0, -0.08, 0.0), (0.0, -0.25, 0.01), 0.045, 0.028),
    ("hand", (0.0, -0.02, 0.0), (0.0, -0.085, 0.0), 0.031, 0.036),
    ("hand", (0.0, -0.085, -0.012), (-0.014, -0.15, -0.01), 0.028, 0.024),
    ("hand", (0.0, -0.085, 0.012), (-0.014, -0.15, 0.012), 0.028, 0.024),
    ("hand", (0.0, -0.02, 0.018), (-0.008, -0.08, 0.05), 0.021, 0.02),
    ("thigh", (0.008, -0.02, -0.012), (0.004, -0.14, 0.004), 0.096, 0.09),
    ("thigh", (0.004, -0.14, 0.004), (0.0, -0.415, 0.005), 0.09, 0.056),
    ("shin", (0.0, 0.0, 0.0), (0.0, -0.12, -0.018), 0.055, 0.058),
    ("shin", (0.0, -0.12, -0.018), (0.0, -0.4, -0.025), 0.058, 0.036),
    ("foot", (0.0, -0.04, -0.03), (-0.01, -0.045, 0.12), 0.044, 0.036),
    ("foot", (0.0, -0.02, 0.0), (0.018, -0.05, 0.12), 0.04, 0.033),
    ("toes", (-0.012, 0.002, 0.0), (-0.014, -0.004, 0.06), 0.035, 0.026),
    ("toes", (0.018, 0.0, 0.0), (0.014, -0.006, 0.045), 0.032, 0.024),
)
SUIT, SKIN, SHOES, HAIR = (0.09, 0.22, 0.42), (0.80, 0.52, 0.38), (0.05, 0.05, 0.06), (0.07, 0.04, 0.03)
COLOURS = {"neck": SKIN, "head": SKIN, "hand.L": SKIN, "hand.R": SKIN}
COLOURS |= {joint + side: SHOES for joint in ("foot", "toes") for side in (".L", ".R")}


@dataclass(frozen=True)
class Body:
    """The surface in the bind pose, the joints that move each vertex, and its colour (linear RGB)."""

    surface: Surface
    joints: Int[np.ndarray, "V 4"]
    weights: Float[np.ndarray, "V 4"]
    colours: Float[np.ndarray, "V 3"]


def limbs() -> list[Limb]:
    """The round cones of the body in the bind pose."""
    world, places = HUMAN.pose(BIND)
    rows = [(row, "", 1.0) for row in FORMS]
    rows += [(row, side, mirror) for side, mirror in ((".L", 1.0), (".R", -1.0)) for row in PAIRS]
    made = []
    for (name, start, end, start_radius, end_radius), side, mirror in rows:
        joint = HUMAN.index(name + side)
        a, b = (places[joint] + world[joint] @ (np.array([mirror, 1.0, 1.0]) * point) for point in (start, end))
        made.append(Limb(joint, a, b, start_radius, end_radius))
    return made


def body(cell: float = CELL) -> Body:
    """The smooth figure, made from its measures alone; triangles are about `cell` metres wide."""
    forms = limbs()
    surface = skin(forms, cell)
    weights = heat_weights(surface, forms, len(HUMAN.names), SHARPNESS)
    joints, kept = strongest(weights)
    return Body(surface, joints, kept, _colours(surface, weights))


def _colours(surface: Surface, weights: Float[np.ndarray, "V J"]) -> Float[np.ndarray, "V 3"]:
    colours = np.array([COLOURS.get(HUMAN.names[joint], SUIT) for joint in weights.argmax(axis=1)])
    x, y, z = (surface.vertices - HUMAN.pose(BIND)[1][HUMAN.index("head")]).T
    scalp = (y > 0.12) & (z < 0.06) | (y > 0.05) & (z < -0.01) | (y > 0.19)
    colours[scalp & (np.abs(x) < 0.15)] = HAIR
    return colours
