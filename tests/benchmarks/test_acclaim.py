"""The Acclaim reader: bones where the angles put them."""

import numpy as np
import pytest

from benchmarks.takes.acclaim import METRES, read_motion, read_skeleton, rotation
from benchmarks.takes.cmu import annotation

INCH = 1 / METRES  # a unit that makes the file's lengths metres
ASF = f"""# two bones: an arm along x whose own frame is turned by 90 degrees about z, and a hand that only bends
:version 1.10
:name VICON
:units
  mass 1.0
  length {METRES}
  angle deg
:documentation
   made for a test
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name arm
     direction 1 0 0
     length 2
     axis 0 0 90 XYZ
    dof rx ry rz
    limits (-180.0 180.0)
           (-180.0 180.0)
           (-180.0 180.0)
  end
  begin
     id 2
     name hand
     direction 1.0 0.0 0.0
     length 1
     axis 0 0 0   XYZ
    dof rz
    limits (-90 90)
  end
:hierarchy
  begin
    root arm
    arm hand
  end
"""


def posed(*lines):
    """Ends of arm and hand for one frame of motion."""
    skeleton = read_skeleton(ASF)
    motion = read_motion("\n".join([":FULLY-SPECIFIED", ":DEGREES", "1", *lines]))
    rotations, starts = skeleton.pose(motion, 1)
    vectors = np.array([bone.vector for bone in skeleton.bones])
    return (starts[0] + np.einsum("bij,bj->bi", rotations[0], vectors))[1:]


def test_at_rest_bones_lie_along_their_directions():
    """No angles: the arm ends at 2, the hand at 3 metres along x."""
    assert np.allclose(posed("root 0 0 0 0 0 0"), [[2, 0, 0], [3, 0, 0]])


def test_angles_are_told_in_the_bones_own_frame():
    """The arm's frame is turned by 90° about z, so its x is the world's y: 90° about it turns the arm to -z."""
    assert np.allclose(posed("root 0 0 0 0 0 0", "arm 90 0 0", "hand 0"), [[0, 0, -2], [0, 0, -3]])


def test_the_first_listed_angle_turns_first():
    """rx then ry then rz: in the arm's frame that is y, then -x, then z of the world."""
    turn = rotation("z", np.array(90.0)) @ rotation("x", np.array(-50.0)) @ rotation("y", np.array(40.0))
    expected = turn @ [2, 0, 0]
    assert np.allclose(posed("root 0 0 0 0 0 0", "arm 40 50 90")[0], expected)


def test_a_child_turns_with_its_parent_and_then_by_itself():
    """Arm up by rz, hand up by another 90°: it points back."""
    assert np.allclose(posed("root 0 0 0 0 0 0", "arm 0 0 90", "hand 90"), [[0, 2, 0], [-1, 2, 0]])


def test_the_root_carries_everything():
    """Its place and turn move the whole figure."""
    assert np.allclose(posed("root 1 2 3 0 90 0", "hand 0"), [[1, 2, 1], [1, 2, 0]])


def test_skeletons_in_radians_are_refused():
    """Rather than misread them."""
    with pytest.raises(ValueError, match="degrees"):
        read_skeleton(ASF.replace("angle deg", "angle rad"))


def test_annotated_cuts_become_frames_of_thirty_a_second():
    """The cut is the last frame of its segment, from 1, at 120 a second; equal labels are one motion."""
    text = "86 01\r\nwalk 30 39 50 \njump 80 81 90\r\nwalk 120 120 120\n\n86 02\nrun 8 8 8\n"
    found = annotation(text, "86_01")
    assert found.labels == ("walk", "jump", "walk")
    assert found.ends == (10, 21, 30)
    assert found.motions == 2
    assert found.frames.tolist() == [0] * 10 + [1] * 11 + [0] * 9


def test_a_captured_walker_stands_on_the_ground(shared):
    """CMU 86_09, one step: metres, upright, a foot near the floor, bones as long as the skeleton says."""
    folder = shared / "data" / "cmu86"
    skeleton = read_skeleton((folder / "86.asf").read_text())
    motion = {bone: rows[400:401] for bone, rows in read_motion((folder / "86_09.amc").read_text()).items()}
    rotations, starts = skeleton.pose(motion, 1)
    foot, head, knee = (skeleton.index(name) for name in ("rfoot", "head", "rtibia"))
    assert np.allclose(rotations @ np.swapaxes(rotations, -1, -2), np.eye(3), atol=1e-9)
    assert 0 < starts[0, foot, 1] < 0.25
    assert 1.4 < starts[0, head, 1] < 1.8
    thigh = np.linalg.norm(starts[0, knee] - starts[0, skeleton.index("rfemur")])
    assert np.isclose(thigh, 8.65257 / 0.45 * METRES, rtol=1e-6)
