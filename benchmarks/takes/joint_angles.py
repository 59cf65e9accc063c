"""Frame features of motion capture as the authors of aligned cluster analysis take them: how joints are turned."""

from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.transform import Rotation

from benchmarks.takes.acclaim import read_motion

JOINTS = (
    "lowerback", "upperback", "thorax", "lowerneck", "upperneck", "head", "rhumerus", "rradius", "lhumerus", "lradius",
    "rfemur", "rtibia", "lfemur", "ltibia",
)  # fmt: skip
"""No root, so that nothing depends on place and heading; no hands, no feet."""


def joint_angles(motion: str) -> Float[np.ndarray, "frames 42"]:
    """Half the rotation vector of every joint, from the text of an .amc file, radians, at its own frame rate.

    From the angles as they are listed (x first), without the skeleton's axes; a joint of one angle turns about x.
    """
    courses = read_motion(motion)
    features = []
    for joint in JOINTS:
        angles = courses[joint]
        angles = np.pad(angles, ((0, 0), (0, 3 - angles.shape[1])))
        features.append(Rotation.from_euler("xyz", angles, degrees=True).as_rotvec() / 2)
    return np.concatenate(features, axis=1)


def true_motions(annotations: Path, trial: str) -> Int[np.ndarray, "frames"]:
    """The motion of every frame of a trial such as `86_09`, at 120 a second, from `mocap.txt`."""
    blocks = annotations.read_text().replace("\r", "").split("\n")
    head = next(i for i, line in enumerate(blocks) if line.split() == trial.split("_"))
    names: list[str] = []
    ends = [0]
    for line in blocks[head + 1 :]:
        if not line.strip():
            break
        name, _, cut, _ = line.split()
        names.append(name)
        ends.append(int(cut))
    numbers = list(dict.fromkeys(names))
    return np.repeat([numbers.index(name) for name in names], np.diff(ends))
