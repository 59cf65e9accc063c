"""`segment_together`: takes by name or by file, one set of motions, takes added, and search."""

import numpy as np
import pytest

from caesura import CaesuraError, JointSegmentation, open_animation, segment_together
from tests.animations import performing_bar
from tests.glb import bending_strip


@pytest.fixture(scope="module")
def joint():
    """Two takes of a bar."""
    takes = {name: performing_bar(order, rings=12).animation for name, order in (("one", [0, 1]), ("two", [1, 0]))}
    return segment_together(takes, motions=2)


def test_motions_are_the_same_in_both_takes(joint):
    """And are still after a file."""
    assert joint.labels("one")[90] == joint.labels("two")[270]
    again = JointSegmentation.from_bytes(joint.to_bytes()).rename(0, "bend")
    assert [motion.shown_name for motion in again.motions] == ["bend", "B"]
    np.testing.assert_array_equal(again.labels("two"), joint.labels("two"))


def test_a_take_is_added_and_searched(joint):
    """By its own frames, or by those of a take that is in none."""
    third = performing_bar([1, 2], rings=12).animation
    more = joint.add(third, "three")
    assert more.labels("three")[90] == joint.labels("two")[90]
    assert len(more.motions) == 3
    found = more.find("three", 60, 120, most=3)
    assert (found[0].take, found[0].distance < 1e-3) == ("three", True)
    beside = joint.find_example(third, most=4, start=1.0, end=3.0)
    labels = {int(joint.labels(one.take)[(one.start + one.end) // 2]) for one in beside}
    assert labels == {int(joint.labels("two")[90])}


def test_takes_of_arrays_need_names():
    """A list is of files; two of one name are refused too."""
    take = performing_bar([0], rings=3).animation
    with pytest.raises(CaesuraError, match="has no name"):
        segment_together([take])
    with pytest.raises(CaesuraError, match="one name"):
        segment_together(["a/take.glb", "b/take.glb"])


def test_joints_stand_where_the_skeleton_is(tmp_path):
    """A skinned mesh has the joints of its skin, by name, at every frame; one without names has none."""
    strip = bending_strip()
    for number, node in enumerate(strip.json["nodes"]):
        node["name"] = f"node {number}"
    (tmp_path / "strip.glb").write_bytes(strip.glb())
    animation = open_animation(tmp_path / "strip.glb")
    assert animation.joints is not None
    joints = strip.json["skins"][0]["joints"]
    assert set(animation.joints.names) == {f"node {joint}" for joint in joints}
    places = animation.joints.positions(0, animation.frames)
    assert places.shape == (animation.frames, len(set(joints)), 3)
    upper = animation.joints.names.index("node 2")
    np.testing.assert_allclose(places[:, upper], np.tile([0, 1, 0], (animation.frames, 1)), atol=1e-6)
    nameless = bending_strip()
    (tmp_path / "nameless.glb").write_bytes(nameless.glb())
    assert open_animation(tmp_path / "nameless.glb").joints is None
