"""A long session as it comes out of a capture studio: T-pose, many motions, retakes, and time when nothing happens."""

import numpy as np

from caesura.samples.body import body
from caesura.samples.model import smooth_glb
from caesura.samples.motions import Motion
from caesura.samples.repertoire import MOTIONS, STILL, T_POSE
from caesura.samples.take import RATE, Part, Sample, perform

SEED = 72
PLAYED = (
    "walk", "run", "sneak", "limp", "march", "jump", "jumping jack", "squat", "lunge", "kick", "punch", "throw",
    "chop", "wave", "clap", "arm circles", "stretch", "bow",
)  # fmt: skip
SECONDS = (7.0, 22.0)  # of one performance
CALIBRATION = (4.0, 6.0)  # of a T-pose
PAUSE = (3.0, 11.0)  # of dead time
PAUSES, RETAKES = 0.3, 0.2  # how often a performance is followed by a pause, or by a pause and a retake
ENDING = 6.0  # the last seconds, in which nothing happens


def long_session(frames: int = 72_000) -> Sample:
    """A session of exactly so many frames (at least 600) at 30 a second, with the smooth figure.

    Every motion of `PLAYED` comes once before any comes again. Dead time is "still", and a motion of its own; two
    performances of one motion never touch. The same bytes at every call.
    """
    random = np.random.default_rng(SEED)
    take = perform(schedule(frames, random), random)
    return Sample(smooth_glb(body(), take), take.truth)


def schedule(frames: int, random: np.random.Generator) -> list[Part]:
    """What is performed, in order: frames of all parts sum to `frames`."""
    parts = [_part(T_POSE, CALIBRATION, random)]
    left = frames - parts[0].frames
    last = ""
    queue: list[str] = []
    while left > ENDING * RATE:
        if not queue:
            queue = random.permutation(PLAYED).tolist()
            if queue[0] == last:
                queue.reverse()
        last = queue.pop(0)
        for part in _performance(MOTIONS[last], random):
            parts.append(part)
            left -= part.frames
    return _ended(parts, frames)


def _performance(motion: Motion, random: np.random.Generator) -> list[Part]:
    chance = random.random()
    first = _part(motion, SECONDS, random)
    if chance < RETAKES:
        return [first, _part(STILL, PAUSE, random), _part(motion, SECONDS, random)]
    return [first, _part(STILL, PAUSE, random)] if chance < RETAKES + PAUSES else [first]


def _part(motion: Motion, seconds: tuple[float, float], random: np.random.Generator) -> Part:
    repetitions = max(1, round(random.uniform(*seconds) / motion.seconds))
    return Part(motion, motion.ends(repetitions, RATE, random))


def _ended(parts: list[Part], frames: int) -> list[Part]:
    """The parts that leave room for a still ending, and the ending that makes it `frames` exactly."""
    while sum(part.frames for part in parts) > frames - ENDING * RATE / 2 or parts[-1].motion is STILL:
        parts.pop()
    left = frames - sum(part.frames for part in parts)
    return [*parts, Part(STILL, np.linspace(0, left, max(2, round(left / RATE / STILL.seconds) + 1))[1:])]
