"""Where the hips are: as high as the lower foot lets them be, and moved along by the foot that is planted."""

import numpy as np
from jaxtyping import Float

from caesura.samples.motions import DRIVES, Course
from caesura.samples.skeleton import HUMAN

SOLE = (("foot", (0.0, -0.085, -0.06)), ("toes", (0.0, -0.03, 0.02)))  # heel and ball: metres from the joint
PRESS = 0.012  # metres: feet this much higher than the lowest carry little
TILT = (-48.0, 42.0)  # degrees an ankle can flex
ROLL = (-22.0, 22.0)  # degrees it can give sideways


def feet_to_ground(angles: Float[np.ndarray, "frames J 3"]) -> Float[np.ndarray, "frames J 3"]:
    """Turns soles told against the ground into flexion of the ankles, as far as ankles go."""
    angles = angles.copy()
    hips = HUMAN.index("hips")
    for side, mirror in ((".L", 1.0), (".R", -1.0)):
        thigh, shin, foot = (HUMAN.index(name + side) for name in ("thigh", "shin", "foot"))
        level = angles[:, hips, 0] + angles[:, shin, 0] - angles[:, thigh, 0]
        angles[:, foot, 0] = np.clip(angles[:, foot, 0] + level, *TILT)
        outward = angles[:, thigh, 1] - mirror * angles[:, hips, 1]
        angles[:, foot, 1] = np.clip(angles[:, foot, 1] - outward, *ROLL)
    return angles


def root(
    course: Course, angles: Float[np.ndarray, "frames J 3"], rate: float
) -> tuple[Float[np.ndarray, "frames"], Float[np.ndarray, "frames 3"]]:
    """Heading in radians and place of the hips; `angles` are those of `feet_to_ground`."""
    lift, speed, turn, slide = (course.drives[:, DRIVES.index(name)] for name in DRIVES)
    heading = np.cumsum(np.radians(turn)) / rate
    soles = _turned(_soles(angles), heading)  # from the hips
    height = soles[..., 1]
    lowest = height.min(axis=1, keepdims=True)
    press = np.exp((lowest - height) / PRESS)
    press /= press.sum(axis=1, keepdims=True)
    carried = (press[1:] + press[:-1])[..., None] / 2 * (soles[1:] - soles[:-1])
    steps = -(1 - slide[1:, None]) * carried.sum(axis=1)
    forward = np.stack([np.sin(heading), np.zeros_like(heading), np.cos(heading)], axis=1)
    steps += (speed[:, None] * forward)[1:] / rate
    place = np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    place[:, 1] = lift - (press * height).sum(axis=1)
    return heading, place


def _soles(angles: Float[np.ndarray, "frames J 3"]) -> Float[np.ndarray, "frames 4 3"]:
    world, places = HUMAN.pose(angles)
    hips = places[:, HUMAN.index("hips")]
    points = []
    for side in (".L", ".R"):
        for joint, offset in SOLE:
            number = HUMAN.index(joint + side)
            points.append(places[:, number] + world[:, number] @ np.array(offset) - hips)
    return np.stack(points, axis=1)


def _turned(
    points: Float[np.ndarray, "frames n 3"], heading: Float[np.ndarray, "frames"]
) -> Float[np.ndarray, "frames n 3"]:
    cos, sin = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([cos * x + sin * z, y, cos * z - sin * x], axis=-1)
