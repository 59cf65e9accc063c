"""What a recording holds between its motions: the calibration pose, and nobody doing anything."""

from caesura.samples.motions import Motion

T_POSE = Motion(
    "t-pose",
    4.0,
    {"upper_arm side": ((0, 80),), "forearm flex": ((0, -12),), "thigh side": ((0, 2),)},
    variation=0.02,
)

STILL = Motion("still", 4.0, {"hips side": ((0, 0.6), (0.5, -0.6)), "spine side": ((0, -0.6), (0.5, 0.6))})
