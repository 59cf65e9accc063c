"""Motions of the trunk that go on and on."""

from caesura.samples.motion_curves import Motion

TURN = Motion(
    "turn",
    1.15,
    {
        "thigh flex": ((0, 0), (0.3, 0), (0.55, 30), (0.75, 22), (0.9, 0)),
        "shin flex": ((0, 0), (0.3, 4), (0.55, 46), (0.75, 26), (0.9, 0)),
        "foot flex": ((0.3, 0), (0.45, -24), (0.62, -8), (0.8, 0)),
        "thigh twist": ((0, 8), (0.5, -8)),
        "upper_arm side": ((0, 16), (0.5, 10)),
        "upper_arm flex": ((0, -8), (0.5, 10)),
        "forearm flex": ((0, 16),),
        "head twist": ((0, 14),),
        "chest twist": ((0.1, 12), (0.6, 6)),
        "turn": ((0, 96),),
    },
    gait=True,
)

SWAY = Motion(
    "sway",
    1.2,
    {
        "hips side": ((0, 11), (0.5, -11)),
        "thigh side": ((0, -11), (0.5, 11)),
        "thigh flex": ((0, 10), (0.5, 28)),
        "shin flex": ((0, 12), (0.5, 42)),
        "foot flex": ((0, 0), (0.5, -16)),
        "spine side": ((0.05, -14), (0.55, 14)),
        "chest side": ((0.1, -8), (0.6, 8)),
        "head side": ((0.15, 8), (0.65, -8)),
        "upper_arm side": ((0, 34), (0.5, 62)),
        "upper_arm twist": ((0, 30), (0.5, 66)),
        "forearm flex": ((0, 74), (0.5, 96)),
        "slide": ((0, 1),),
    },
    gait=True,
)

TWIST = Motion(
    "twist",
    0.92,
    {
        "hips twist": ((0, 28), (0.5, -28)),
        "chest twist": ((0, -40), (0.5, 40)),
        "head twist": ((0, 10), (0.5, -10)),
        "thigh flex": ((0, 24), (0.5, 36)),
        "shin flex": ((0, 38), (0.5, 52)),
        "foot flex": ((0, -18),),
        "upper_arm flex": ((0, 34), (0.5, -14)),
        "upper_arm side": ((0, 22),),
        "forearm flex": ((0, 78),),
        "spine flex": ((0, 8),),
        "lift": ((0, 0.0), (0.25, 0.015), (0.5, 0.0), (0.75, 0.015)),
        "slide": ((0, 1),),
    },
    gait=True,
)
