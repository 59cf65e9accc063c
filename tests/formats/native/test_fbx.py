"""FBX: read by a library in a process of its own, and posed as any other glTF. Answers are worked out by hand."""

import io
import json

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.read import list_takes
from caesura.formats.upload_summary import read_header
from tests.formats.native.fbx_binary import binary
from tests.formats.native.fbx_text import SQUARE, FbxText, bending_strip, blending_square, moving_square
from tests.formats.opening import codes, opened

T, R, S = "Lcl Translation", "Lcl Rotation", "Lcl Scaling"


def corner(made: FbxText, frame: int, **parameters: object) -> list[float]:
    """Where the corner (1, 1) of the square of a file is, in metres."""
    take = opened(made.data(), **parameters)
    assert take.vertex_count == 4
    return take.vertices(frame, frame + 1)[0, 2].tolist()  # type: ignore[no-any-return]


def square(*rows: tuple[object, ...], parent: tuple[tuple[object, ...], ...] | None = None) -> tuple[FbxText, int, int]:
    """A file with a square, its node, and a layer of a take of one second that moves nothing yet."""
    made = FbxText()
    above = 0 if parent is None else made.model("above", *parent)
    node = made.model("square", *rows, parent=above, subtype="Mesh")
    made.mesh(SQUARE, [(0, 1, 2, 3)], node)
    return made, node, made.layer(made.stack("take", 0, 1))


def test_centimetres_become_metres_and_frames_are_the_file_s() -> None:
    """A square of a centimetre that goes 30 of them in a second, at 30 frames a second and at 24."""
    take = opened(moving_square().data())
    assert (take.frames, take.frame_rate, take.take.name) == (31, 30, "slide")
    np.testing.assert_allclose(take.vertices(0, 31)[:, 0, 0], np.linspace(0, 0.3, 31), atol=1e-7)
    assert opened(moving_square(rate=24).data()).frames == 25


def test_any_unit_and_axis_become_metres_with_y_up() -> None:
    """In inches, and with z up: what was up is up."""
    assert corner(moving_square(unit_centimetres=2.54), 30) == pytest.approx([31 * 0.0254, 0.0254, 0])
    assert corner(moving_square(up="z"), 30) == pytest.approx([0.31, 0, -0.01])


def test_a_skin_bends_where_its_bones_bend() -> None:
    """The knee turns by 90 degrees: its vertices with it, those between the bones by half."""
    strip = opened(bending_strip().data())
    expected = np.array([[0, 0], [1, 0], [0, 1], [0.5, 1.5], [-1, 1], [-1, 2]]) / 100
    np.testing.assert_allclose(strip.vertices(30, 31)[0, :, :2], expected, atol=1e-7)


def test_a_vertex_that_no_bone_moves_stays_with_its_mesh() -> None:
    """And is not taken along by the first bone."""
    made = bending_strip()
    made.objects = [text.replace("a: 1,1,0.5,0.5", "a: 0,0,0.5,0.5") for text in made.objects]
    made.animate(made.layer(made.stack("fall", 0, 1)), 100, T, [0, 1], y=[0, -50])
    fallen = opened(made.data(), take="fall").vertices(30, 31)[0]
    np.testing.assert_allclose(fallen[:2, 1], 0, atol=1e-7)
    assert (fallen[2:, 1] < -0.4).all()


def test_a_vertex_may_have_more_than_four_bones() -> None:
    """Six bones of equal weight, one of which rises by six."""
    made, _, layer = square()
    bones = [made.model(f"bone {i}", subtype="LimbNode") for i in range(6)]
    geometry = 100 + next(i for i, text in enumerate(made.objects) if text.startswith("Geometry"))
    made.skin(geometry, [(bone, range(4), [1 / 6] * 4, (0, 0, 0)) for bone in bones])
    made.animate(layer, bones[3], T, [0, 1], z=[0, 6])
    assert corner(made, 30) == pytest.approx([0.01, 0.01, 0.01])


def test_a_shape_between_is_there_alone_at_its_weight() -> None:
    """It rises to 4 at half the time and sinks to 1; a quarter is half of the first, three quarters half of both."""
    take = opened(blending_square().data(), fps=60)
    heights = take.vertices(0, 61)[:, 2, 2] * 100
    np.testing.assert_allclose(heights[[0, 15, 30, 45, 60]], [0, 2, 4, 2.5, 1], atol=1e-5)


def test_a_shape_may_outweigh_itself() -> None:
    """At 200 percent of one shape, and at -100."""
    made = FbxText()
    node = made.model("square", subtype="Mesh")
    channel = made.blend_channel(made.mesh(SQUARE, [(0, 1, 2, 3)], node), [(100, [2], [(0, 0, 3)])])
    made.animate(made.layer(made.stack("blend", 0, 1)), channel, "DeformPercent", [0, 1], d=[-100, 200])
    assert corner(made, 0) == pytest.approx([0.01, 0.01, -0.03])
    assert corner(made, 30) == pytest.approx([0.01, 0.01, 0.06])


def test_layers_add_up_by_their_weights() -> None:
    """Ten to the right on the first, twenty up on the second at half its weight."""
    made, node, layer = square()
    made.animate(layer, node, T, [0, 1], x=[0, 10])
    stack = next(100 + i for i, text in enumerate(made.objects) if text.startswith("AnimationStack"))
    made.animate(made.layer(stack, ("Weight", "Number", 50)), node, T, [0, 1], y=[0, 20])
    assert corner(made, 30) == pytest.approx([0.11, 0.11, 0])


@pytest.mark.parametrize(("order", "axes"), [*enumerate(("xyz", "xzy", "yzx", "yxz", "zxy", "zyx"))])
def test_every_order_of_rotations_is_read(order: int, axes: str) -> None:
    """Turns of 90, 45 and 30 degrees; the first axis of an order is turned about first."""
    turns = {"x": _turn("x", 90), "y": _turn("y", 45), "z": _turn("z", 30)}
    matrix = turns[axes[2]] @ turns[axes[1]] @ turns[axes[0]]
    made, node, layer = square(("RotationOrder", "enum", order), ("RotationActive", "bool", 1))
    made.animate(layer, node, R, [0, 1], x=[0, 90], y=[0, 45], z=[0, 30])
    np.testing.assert_allclose(corner(made, 30), matrix @ [0.01, 0.01, 0], atol=1e-7)


def _turn(axis: str, degrees: float) -> np.ndarray:
    a = np.radians(degrees)
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[first, first] = matrix[second, second] = np.cos(a)
    matrix[second, first], matrix[first, second] = np.sin(a), -np.sin(a)
    return matrix


def test_a_node_turns_about_its_pivot() -> None:
    """About its corner (1, 1), which stays where it is."""
    pivots = [("RotationPivot", "Vector3D", 1, 1, 0), ("ScalingPivot", "Vector3D", 1, 1, 0)]
    made, node, layer = square(*pivots, ("RotationActive", "bool", 1))
    made.animate(layer, node, R, [0, 1], z=[0, 90])
    made.animate(layer, node, S, [0, 1], x=[1, 3], rest=(1, 1, 1))
    assert corner(made, 30) == pytest.approx([0.01, 0.01, 0])
    np.testing.assert_allclose(opened(made.data()).vertices(30, 31)[0, 0], [0.02, -0.02, 0], atol=1e-7)


@pytest.mark.parametrize(("inherit", "expected"), [(0, (0.06, 0.01, 0)), (1, (0.06, 0.01, 0)), (2, (0.04, 0.01, 0))])
def test_scale_is_inherited_as_the_node_says(inherit: int, expected: tuple[float, ...]) -> None:
    """A parent that grows threefold: the place of its child does, and its size unless the child does not inherit it."""
    made, _, layer = square(("InheritType", "enum", inherit), (T, T, 1, 0, 0), parent=())
    made.animate(layer, 100, S, [0, 1], x=[1, 3], rest=(1, 1, 1))
    assert corner(made, 30) == pytest.approx(expected)


def test_a_geometry_may_stand_apart_from_its_node() -> None:
    """A geometric translation moves the mesh and nothing below the node."""
    made, node, layer = square(("GeometricTranslation", "Vector3D", 0, 0, 5))
    made.animate(layer, node, T, [0, 1], x=[0, 1])
    assert corner(made, 30) == pytest.approx([0.02, 0.01, 0.05])


def test_stacks_are_takes_and_the_one_that_moves_is_read() -> None:
    """The first has no curves and is as long, as in files of Mixamo; it can be asked for, and moves nothing."""
    made = FbxText()
    node = made.model("square", subtype="Mesh")
    made.mesh(SQUARE, [(0, 1, 2, 3)], node)
    made.layer(made.stack("Take 001", 0, 2))
    made.animate(made.layer(made.stack("mixamo.com", 0, 2)), node, T, [0, 2], x=[0, 1])
    data = made.data()
    take = opened(data).take
    assert (take.index, take.name, take.frames) == (1, "mixamo.com", 61)
    assert [(found.name, found.frames) for found in list_takes({"a.fbx": data}, Limits())] == [
        ("Take 001", 61),
        ("mixamo.com", 61),
    ]
    with pytest.raises(InvalidModel, match="moves nothing"):
        opened(data, take=0)


def test_a_take_that_begins_later_is_counted_from_its_first_frame() -> None:
    """Frame 0 is the one at 4 seconds, and a notice says so; what another take does is not in it."""
    made, node, layer = square()
    made.animate(layer, node, T, [0, 1], x=[0, 100])
    late = made.layer(made.stack("late", 4, 5))
    made.animate(late, node, T, [4, 5], y=[0, 10])
    take = opened(made.data(), take="late")
    assert (take.frames, take.start_seconds) == (31, 0)
    np.testing.assert_allclose(take.vertices(30, 31)[0, 2], [0.01, 0.11, 0], atol=1e-7)
    (notice,) = (notice for notice in take.notices if notice.code == "take-start")
    assert "frame 120" in notice.detail


def test_a_take_without_a_span_is_as_long_as_its_keys() -> None:
    """And so is one that claims all of time."""
    for begin, end in ((0, 0), (0, 1e9)):
        made = FbxText()
        node = made.model("square", subtype="Mesh")
        made.mesh(SQUARE, [(0, 1, 2, 3)], node)
        made.animate(made.layer(made.stack("take", begin, end)), node, T, [0, 2], x=[0, 1])
        assert opened(made.data()).frames == 61


def test_a_skeleton_without_a_mesh_is_read() -> None:
    """Its joints are its vertices, by their names."""
    made = FbxText()
    hip = made.model("hip", subtype="LimbNode")
    made.model("knee", (T, T, 0, 40, 0), parent=hip, subtype="LimbNode")
    made.animate(made.layer(made.stack("walk", 0, 1)), hip, T, [0, 1], x=[0, 100])
    take = opened(made.data())
    assert codes(take) == {"skeleton-only"}
    np.testing.assert_allclose(take.vertices(30, 31)[0], [[1, 0, 0], [1, 0.4, 0]], atol=1e-6)


def test_the_glb_has_names_colours_and_only_what_moves() -> None:
    """What an engine gets of the clips."""
    take = opened(moving_square().data())
    assert take.gltf is not None
    glb = bytes(take.gltf[""])
    root = json.loads(glb[20 : 20 + int.from_bytes(glb[12:16], "little")])
    assert [node["name"] for node in root["nodes"]] == ["square"]
    assert root["materials"][0]["name"] == "red"
    colour = root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
    assert colour == pytest.approx([0.5, 0.25, 0, 1])
    (channel,) = root["animations"][0]["channels"]
    assert channel["target"]["path"] == "translation"


def test_the_binary_kind_is_read_as_the_text() -> None:
    """The same vertices, and a header that says the same of it."""
    text = bending_strip().data()
    same = binary(text)
    np.testing.assert_array_equal(opened(same).vertices(0, 31), opened(text).vertices(0, 31))
    heads = [read_header(io.BytesIO(data), "strip.fbx", Limits()) for data in (text, same)]
    assert heads[0].takes == heads[1].takes
    assert heads[1].takes[0].frames == 31
    assert (heads[1].vertices, heads[1].triangles) == (6, 4)


def test_a_mesh_and_its_motion_may_come_in_two_files() -> None:
    """As Mixamo sends them: the character, and a motion without a skin."""
    character, motion = bending_strip(), FbxText()
    character.objects = [text for text in character.objects if not text.startswith("Animation")]
    hip = motion.model("hip", subtype="LimbNode")
    knee = motion.model("knee", (T, T, 0, 1, 0), parent=hip, subtype="LimbNode")
    motion.animate(motion.layer(motion.stack("bend", 0, 1)), knee, R, [0, 1], z=[0, 90])
    take = opened({"character.fbx": character.data(), "bend.fbx": motion.data()})
    assert "skeleton-paired" in codes(take)
    np.testing.assert_allclose(take.vertices(30, 31)[0, 5, :2], [-0.01, 0.02], atol=1e-7)


def test_a_broken_file_is_refused_by_its_name() -> None:
    """Cut off, and of a version that is not read."""
    data = moving_square().data()
    with pytest.raises(BrokenContainer) as refused:
        opened({"walk.fbx": data[: len(data) // 2]})
    assert refused.value.code == "malformed-fbx"
    assert refused.value.where["file"] == "walk.fbx"
    with pytest.raises(InvalidModel) as old:
        opened({"walk.fbx": b"Kaydara FBX Binary  \0\x1a\0" + (2000).to_bytes(4, "little") + b"\xff" * 40})
    assert old.value.code == "unsupported-fbx-version"


@pytest.mark.parametrize(
    ("limits", "setting"),
    [
        (Limits(max_nodes=1), "MAX_NODES"),
        (Limits(max_vertices=4), "MAX_VERTICES"),
        (Limits(max_triangles=2), "MAX_TRIANGLES"),
        (Limits(max_frames=20), "MAX_FRAMES"),
        (Limits(max_seconds=0.5), "MAX_SECONDS"),
        (Limits(max_node_frames=20), "MAX_NODE_FRAMES"),
        (Limits(max_decoded_bytes=1000), "MAX_DECODED_BYTES"),
    ],
)
def test_what_is_too_large_is_refused(limits: Limits, setting: str) -> None:
    """Before it is sampled; the setting is named."""
    with pytest.raises(LimitExceeded, match=setting):
        opened(bending_strip().data(), limits)
