"""The two short sample characters, each with the truth of what it performs."""

from functools import cache

import numpy as np

from caesura.samples.body import body
from caesura.samples.model import rigid_glb, smooth_glb
from caesura.samples.parts import parts
from caesura.samples.repertoire import MOTIONS
from caesura.samples.take import RATE, Part, Sample, perform

CHOREOGRAPHIES = {
    "smooth": (
        ("walk", 6), ("wave", 8), ("squat", 3), ("walk", 5), ("jump", 4), ("clap", 8), ("squat", 3), ("wave", 7),
        ("walk", 4),
    ),
    "rigid": (
        ("march", 7), ("punch", 8), ("look around", 2), ("kick", 4), ("march", 6), ("arm circles", 5), ("punch", 7),
        ("kick", 4), ("bow", 2),
    ),
}  # fmt: skip
SEEDS = {"smooth": 86, "rigid": 9}
FIGURES = tuple(CHOREOGRAPHIES)


@cache
def figure(name: str) -> Sample:
    """One of `FIGURES`: a minute or less at 30 frames a second. The same bytes at every call."""
    random = np.random.default_rng(SEEDS[name])
    motions = [(MOTIONS[motion], times) for motion, times in CHOREOGRAPHIES[name]]
    take = perform([Part(motion, motion.ends(times, RATE, random)) for motion, times in motions], random)
    glb = smooth_glb(body(), take) if name == "smooth" else rigid_glb(parts(), take)
    return Sample(glb, take.truth)
