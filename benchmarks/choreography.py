"""Takes made up by a seed: motions of the repertoire, some of them again, performed by the two sample characters."""

import numpy as np

from samples.body import body
from samples.model import rigid_glb, smooth_glb
from samples.parts import parts
from samples.repertoire import MOTIONS
from samples.take import RATE, Part, Sample, perform

SECONDS = (3.5, 10.0)  # of a segment
HELD_BACK = tuple(range(301, 309))
"""Seeds at which nobody looked while the methods were made."""


def choreography(seed: int) -> Sample:
    """Four to seven motions in about twice as many segments; odd seeds are smooth, even ones made of rigid parts."""
    random = np.random.default_rng(seed)
    count = 4 + seed % 4
    chosen = random.choice(sorted(MOTIONS), count, replace=False).tolist()
    order = list(chosen)
    while len(order) < 2 * count:
        following = chosen[random.integers(count)]
        order += [following] if following != order[-1] else []
    performed = []
    for name in order:
        motion = MOTIONS[name]
        repetitions = max(round(random.uniform(*SECONDS) / motion.seconds), 1)
        performed.append(Part(motion, motion.ends(repetitions, RATE, random)))
    take = perform(performed, random)
    return Sample(smooth_glb(body(), take) if seed % 2 else rigid_glb(parts(), take), take.truth)
