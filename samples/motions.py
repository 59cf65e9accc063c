"""What a motion is: curves of joint angles over one repetition, performed again and again, never twice the same."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float
from scipy.interpolate import PchipInterpolator

from caesura.samples.skeleton import AXES, HUMAN, JOINTS, straight

Keys = Sequence[tuple[float, float]]  # (phase in [0, 1), value), read as a periodic curve
DRIVES = ("lift", "speed", "turn", "slide")  # metres off the ground; metres/s forward; degrees/s; share not planted
PAIRED = {name[:-2] for name in HUMAN.names if name.endswith(".L")}


@dataclass(frozen=True)
class Course:
    """A figure over time: `angles` of all joints in degrees, and `drives`, how it moves over the ground."""

    angles: Float[np.ndarray, "frames J 3"]
    drives: Float[np.ndarray, "frames 4"]


@dataclass(frozen=True)
class Motion:
    """One repetition takes about `seconds`. `curves` are keyed `joint axis`, `joint.L axis` or a drive's name.

    A paired joint without a side means both: together, or half a repetition apart where the motion is a `gait`
    (there the other trunk axes mirror by themselves, as written). A sole's flexion is told against the ground,
    and the ankle does what it must. `variation` is the spread of speed and size from repetition to repetition.
    """

    name: str
    seconds: float
    curves: Mapping[str, Keys]
    gait: bool = False
    variation: float = 0.08

    @cached_property
    def tracks(self) -> tuple[tuple[int, int, float, PchipInterpolator], ...]:
        """Joint, axis, phase shift and curve of everything that moves; drives have joint -1."""
        tracks = []
        for key, keys in self.curves.items():
            joint, _, axis = key.partition(" ")
            spline = _periodic(keys)
            if not axis:
                tracks.append((-1, DRIVES.index(joint), 0.0, spline))
            elif joint in PAIRED:
                tracks.append((HUMAN.index(joint + ".L"), AXES.index(axis), 0.0, spline))
                tracks.append((HUMAN.index(joint + ".R"), AXES.index(axis), 0.5 * self.gait, spline))
            else:
                tracks.append((HUMAN.index(joint), AXES.index(axis), 0.0, spline))
        return tuple(tracks)

    def perform(
        self,
        frames: Float[np.ndarray, "frames"],
        ends: Float[np.ndarray, "repetitions"],
        random: np.random.Generator,
    ) -> Course:
        """The figure at `frames`, where repetition i ends at frame `ends[i]` and the first begins at 0.

        Frames before 0 and after the last end go on with the motion, for cross-fades.
        """
        phase = _phase(frames, ends)
        sizes = np.clip(1 + self.variation * random.standard_normal((len(ends), 1)), 0.6, 1.3)
        sizes = sizes * (1 + 0.5 * self.variation * random.standard_normal((len(ends), JOINTS)))
        habit = 2.5 * random.standard_normal((JOINTS, 3))
        size = _between(sizes, phase)
        angles = np.broadcast_to(STANCE + habit * LOOSE, (len(frames), JOINTS, 3)).copy()
        drives = np.zeros((len(frames), len(DRIVES)))
        for joint, axis, shift, spline in self.tracks:
            value = spline((phase + shift) % 1.0)
            if joint < 0:
                drives[:, axis] = value
            else:
                angles[:, joint, axis] += size[:, joint] * value
        return Course(angles, drives)

    def ends(self, repetitions: int, rate: float, random: np.random.Generator) -> Float[np.ndarray, "repetitions"]:
        """Frames at which the repetitions end, each done at its own speed; the last is a whole frame."""
        pace = 1 + 0.6 * self.variation * random.standard_normal()
        speeds = np.clip(pace * (1 + self.variation * random.standard_normal(repetitions)), 0.7, 1.4)
        ends: Float[np.ndarray, "repetitions"] = np.cumsum(self.seconds * rate / speeds)
        ends *= round(ends[-1]) / ends[-1]
        return ends


def _stance() -> Float[np.ndarray, "J 3"]:
    angles = straight()
    for joint, axis, value in (
        ("upper_arm", "side", 9.0),
        ("upper_arm", "flex", 2.0),
        ("forearm", "flex", 14.0),
        ("thigh", "side", 4.0),
        ("thigh", "flex", 3.0),
        ("shin", "flex", 5.0),
    ):
        for side in (".L", ".R"):
            angles[HUMAN.index(joint + side), AXES.index(axis)] = value
    return angles


def _loose() -> Float[np.ndarray, "J 3"]:
    """How much of a performer's habit each angle takes: knees, feet and hips keep what balance asks of them."""
    loose = np.ones((JOINTS, 3))
    for joint, name in enumerate(HUMAN.names):
        if name.startswith(("shin", "foot", "toes", "hips", "clavicle")):
            loose[joint] = 0.0
        elif name.startswith("thigh"):
            loose[joint] = (0.3, 0.5, 0.5)
    return loose


def _periodic(keys: Keys) -> PchipInterpolator:
    """Eases in and out of every extreme, as animators' curves do, and never beyond it."""
    phase, value = np.array(sorted(keys)).T
    return PchipInterpolator(np.concatenate([phase - 1, phase, phase + 1]), np.tile(value, 3))


def _phase(frames: Float[np.ndarray, "frames"], ends: Float[np.ndarray, "repetitions"]) -> Float[np.ndarray, "frames"]:
    """Repetitions done at each frame: 0 at frame 0, i + 1 at `ends[i]`; the speed changes smoothly."""
    times = np.concatenate([[0.0], ends])
    first, last = times[1] - times[0], times[-1] - times[-2]
    times = np.concatenate([[-first], times, [times[-1] + last]])
    phase: Float[np.ndarray, "frames"] = PchipInterpolator(times, np.arange(-1.0, len(ends) + 2))(frames)
    return phase


def _between(
    sizes: Float[np.ndarray, "repetitions J"], phase: Float[np.ndarray, "frames"]
) -> Float[np.ndarray, "frames J"]:
    """Sizes held in the middle of each repetition, going over smoothly from one to the next."""
    if len(sizes) == 1:
        return np.broadcast_to(sizes, (len(phase), sizes.shape[1]))
    middle = np.arange(len(sizes)) + 0.5
    between: Float[np.ndarray, "frames J"] = PchipInterpolator(middle, sizes)(np.clip(phase, middle[0], middle[-1]))
    return between


STANCE = _stance()
LOOSE = _loose()
