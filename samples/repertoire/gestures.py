"""Motions of the arms and the head, on the spot."""

from caesura.samples.motions import Motion

WAVE = Motion(
    "wave",
    0.72,
    {
        "upper_arm.R side": ((0, 80), (0.5, 86)),
        "upper_arm.R twist": ((0, 84), (0.5, 76)),
        "upper_arm.R flex": ((0, 14),),
        "forearm.R flex": ((0.0, 42), (0.5, 100)),
        "hand.R flex": ((0.1, -20), (0.6, 22)),
        "clavicle.R side": ((0, 10),),
        "spine side": ((0, 3), (0.5, 6)),
        "head side": ((0, -3), (0.5, -7)),
        "head twist": ((0, -8),),
    },
    variation=0.1,
)

CLAP = Motion(
    "clap",
    0.74,
    {
        "upper_arm flex": ((0, 50), (0.5, 44)),
        "upper_arm side": ((0, -12), (0.5, 16)),
        "upper_arm twist": ((0, -26), (0.5, -6)),
        "forearm flex": ((0, 62), (0.5, 58)),
        "hand flex": ((0, 0), (0.5, -14)),
        "chest flex": ((0, 3), (0.5, -1)),
        "head flex": ((0, 4), (0.5, 0)),
    },
    variation=0.1,
)

ARM_CIRCLES = Motion(
    "arm circles",
    1.3,
    {
        "upper_arm side": ((0, 46), (0.5, 112)),
        "upper_arm flex": ((0.25, 34), (0.75, -34)),
        "upper_arm twist": ((0, 20), (0.5, 44)),
        "forearm flex": ((0, -6),),
        "clavicle side": ((0.05, 2), (0.55, 18)),
        "chest flex": ((0.25, 3), (0.75, -4)),
    },
)

STRETCH = Motion(
    "stretch",
    3.4,
    {
        "upper_arm side": ((0, 148), (0.25, 154), (0.75, 154)),
        "upper_arm twist": ((0, 60),),
        "forearm flex": ((0, 6), (0.25, 18), (0.5, 6), (0.75, 18)),
        "clavicle side": ((0, 22), (0.25, 26), (0.75, 26)),
        "spine side": ((0, 0), (0.25, 24), (0.5, 0), (0.75, -24)),
        "chest side": ((0, 0), (0.25, 16), (0.5, 0), (0.75, -16)),
        "hips side": ((0.25, -5), (0.75, 5)),
        "head side": ((0.25, 12), (0.75, -12)),
        "spine flex": ((0, -8),),
        "thigh side": ((0, 8),),
    },
)

LOOK_AROUND = Motion(
    "look around",
    3.2,
    {
        "head twist": ((0, 0), (0.2, 46), (0.34, 50), (0.7, -46), (0.84, -50)),
        "neck twist": ((0, 0), (0.2, 20), (0.34, 22), (0.7, -20), (0.84, -22)),
        "chest twist": ((0, 0), (0.24, 18), (0.36, 20), (0.74, -18), (0.86, -20)),
        "spine twist": ((0, 0), (0.26, 10), (0.76, -10)),
        "head flex": ((0.1, 0), (0.28, -14), (0.5, 8), (0.78, -10)),
        "upper_arm flex": ((0.28, 8), (0.78, 2)),
        "hips side": ((0.28, 3), (0.78, -3)),
    },
)

BOW = Motion(
    "bow",
    2.8,
    {
        "hips flex": ((0, 0), (0.1, 0), (0.42, 38), (0.58, 38), (0.9, 0)),
        "thigh flex": ((0.1, 0), (0.42, 34), (0.58, 34), (0.9, 0)),
        "spine flex": ((0.1, 0), (0.42, 26), (0.58, 26), (0.9, 0)),
        "chest flex": ((0.1, 0), (0.45, 16), (0.58, 16), (0.9, 0)),
        "neck flex": ((0.1, 0), (0.45, 16), (0.58, 16), (0.9, 0)),
        "upper_arm.R flex": ((0.1, 0), (0.45, 52), (0.58, 52), (0.9, 0)),
        "forearm.R flex": ((0.1, 0), (0.45, 84), (0.58, 84), (0.9, 0)),
        "upper_arm.R twist": ((0.1, 0), (0.45, -46), (0.58, -46), (0.9, 0)),
        "upper_arm.L side": ((0.1, 0), (0.45, 40), (0.58, 40), (0.9, 0)),
        "upper_arm.L flex": ((0.1, 0), (0.45, -10), (0.58, -10), (0.9, 0)),
    },
)

DRINK = Motion(
    "drink",
    2.9,
    {
        "upper_arm.R flex": ((0, 0), (0.06, 0), (0.34, 58), (0.5, 74), (0.64, 70), (0.92, 0)),
        "upper_arm.R side": ((0.06, 0), (0.36, 14), (0.62, 20), (0.92, 0)),
        "upper_arm.R twist": ((0.06, 0), (0.36, -44), (0.62, -44), (0.92, 0)),
        "forearm.R flex": ((0.06, 0), (0.34, 112), (0.62, 118), (0.92, 0)),
        "hand.R flex": ((0.06, 0), (0.5, 24), (0.92, 0)),
        "head flex": ((0.3, 0), (0.5, -24), (0.62, -24), (0.8, 0)),
        "neck flex": ((0.3, 0), (0.5, -10), (0.62, -10), (0.8, 0)),
        "chest flex": ((0.3, 0), (0.55, -6), (0.85, 0)),
    },
)
