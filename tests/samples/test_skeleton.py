"""The skeleton: angles in, places and rotations out."""

import numpy as np
from scipy.spatial.transform import Rotation

from caesura.samples.skeleton import AXES, HUMAN, arms_out, quaternions, straight


def bent(joint, axis, degrees):
    """Standing straight but for one angle."""
    angles = straight()
    angles[HUMAN.index(joint), AXES.index(axis)] = degrees
    return HUMAN.pose(angles)[1]


def test_standing_straight_every_joint_is_at_its_own_place():
    """No angle, no movement."""
    _, places = HUMAN.pose(straight())
    assert np.allclose(places, HUMAN.places)


def test_joints_bend_the_way_bodies_do():
    """A raised thigh brings the knee forward, a bent knee the foot back, a bent elbow the hand forward."""
    knee, foot, hand = (HUMAN.index(name) for name in ("shin.L", "foot.L", "hand.L"))
    assert bent("thigh.L", "flex", 60)[knee, 2] > 0.3
    assert bent("shin.L", "flex", 60)[foot, 2] < -0.3
    assert bent("forearm.L", "flex", 60)[hand, 2] > 0.15
    assert bent("hips", "flex", 30)[HUMAN.index("head"), 2] > 0.25


def test_left_and_right_mirror_each_other():
    """The same angle on both sides gives places that differ in the sign of x."""
    left, right = (bent("upper_arm" + side, "side", 70) for side in (".L", ".R"))
    hand_left, hand_right = left[HUMAN.index("hand.L")], right[HUMAN.index("hand.R")]
    assert np.allclose(hand_left, hand_right * [-1, 1, 1])
    assert hand_left[0] > 0.5


def test_arms_out_at_ninety_degrees_are_level():
    """That is the T-pose."""
    _, places = HUMAN.pose(arms_out(90.0))
    shoulder, hand = places[HUMAN.index("upper_arm.L")], places[HUMAN.index("hand.L")]
    assert abs(shoulder[1] - hand[1]) < 0.02


def test_quaternions_turn_as_their_matrices_do_and_never_jump():
    """Three turns about a tilted axis: the same rotations, and neighbours on the same side of the sphere."""
    turns = np.linspace(0, 6 * np.pi, 400)[:, None] * np.array([0.6, 0.0, 0.8])
    matrices = Rotation.from_rotvec(turns).as_matrix()
    found = quaternions(matrices)
    assert np.allclose(Rotation.from_quat(found).as_matrix(), matrices, atol=1e-12)
    assert np.allclose(np.linalg.norm(found, axis=1), 1)
    assert ((found[1:] * found[:-1]).sum(axis=1) > 0.99).all()
