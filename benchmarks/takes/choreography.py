"""Takes made up by a seed: motions of the repertoire, some of them again, performed by the two sample characters."""

from dataclasses import replace

import numpy as np

from caesura.samples.figure_glb import rigid_glb, smooth_glb
from caesura.samples.motion_curves import PAIRED, Motion
from caesura.samples.performed_take import RATE, Part, Sample, perform_take
from caesura.samples.repertoire import MOTIONS, STILL, T_POSE
from caesura.samples.robot_parts import build_parts
from caesura.samples.smooth_body import build_body

SECONDS = (3.5, 10.0)  # of a segment


def choreography(seed: int, motions: int | None = None, seconds: tuple[float, float] = SECONDS) -> Sample:
    """So many motions, or four to seven, in about twice as many segments; odd seeds are smooth, even ones of rigid
    parts.

    Above 23 the repertoire is not enough: motions of one side are performed with the other too.
    """
    random = np.random.default_rng(seed)
    count = motions or 4 + seed % 4
    repertoire = MOTIONS if count <= len(MOTIONS) else MOTIONS | both_sides()
    chosen = random.choice(sorted(repertoire), count, replace=False).tolist()
    order = list(chosen)
    while len(order) < 2 * count:
        following = chosen[random.integers(count)]
        order += [following] if following != order[-1] else []
    performed = []
    for name in order:
        motion = repertoire[name]
        repetitions = max(round(random.uniform(*seconds) / motion.seconds), 1)
        performed.append(Part(motion, motion.ends(repetitions, RATE, random)))
    take = perform_take(performed, random)
    return Sample(smooth_glb(build_body(), take) if seed % 2 else rigid_glb(build_parts(), take), take.truth)


def both_sides() -> dict[str, Motion]:
    """Standing still, the calibration pose, and the motions of one side performed by the other."""
    one_sided = [m for m in MOTIONS.values() if any(key[-2:] in (".L", ".R") for key in map(_joint, m.curves))]
    return {m.name: m for m in (STILL, T_POSE, *map(mirrored, one_sided))}


def mirrored(motion: Motion) -> Motion:
    """The same motion with left and right exchanged, of another name."""
    curves = {}
    for key, keys in motion.curves.items():
        joint, _, axis = key.partition(" ")
        turned = joint not in PAIRED and joint[-2:] not in (".L", ".R") and axis in ("side", "twist")
        sign = -1.0 if turned or key == "turn" else 1.0
        other = joint.replace(".L", ".?").replace(".R", ".L").replace(".?", ".R")
        curves[key.replace(joint, other, 1)] = tuple((phase, sign * value) for phase, value in keys)
    return replace(motion, name=f"{motion.name}, other side", curves=curves)


def _joint(key: str) -> str:
    return key.partition(" ")[0]
