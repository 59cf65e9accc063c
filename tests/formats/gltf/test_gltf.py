"""glTF by analytic answers: small models whose every vertex is known."""

import numpy as np
import pytest

from caesura.core.errors import InvalidModel, ParameterError
from tests.formats.opening import codes, opened
from tests.glb import SQUARE, SQUARE_TRIANGLES, Glb, bending_strip, moving_square, square

HALF = np.sqrt(0.5)
QUARTER_TURN = [[0, 0, 0, 1], [0, 0, HALF, HALF]]


def frames(model: Glb, **parameters: object) -> np.ndarray:
    """All frames of a model, ten a second."""
    animation = opened(model.glb(), **{"fps": 10, **parameters})
    return animation.vertices(0, animation.frames)


def turned(degrees: float, points: object = SQUARE) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(points, float) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T


def test_a_linear_translation_goes_straight() -> None:
    """Half way in time is half way in space."""
    np.testing.assert_allclose(frames(moving_square())[5], np.add(SQUARE, [0.5, 0, 0]), atol=1e-6)


def test_a_linear_rotation_turns_evenly() -> None:
    """A quarter turn about z in a second: 45° after half of it, on the arc and not on the chord."""
    model = square()
    model.animate(0, "rotation", [0, 1], QUARTER_TURN)
    found = frames(model)
    for frame in range(11):
        np.testing.assert_allclose(found[frame], turned(9 * frame), atol=1e-6)


def test_a_rotation_takes_the_shorter_way() -> None:
    """A quaternion and its negative are the same rotation; the sign of a key changes nothing."""
    model, negated = square(), square()
    model.animate(0, "rotation", [0, 1], QUARTER_TURN)
    negated.animate(0, "rotation", [0, 1], np.multiply(QUARTER_TURN, [[1], [-1]]))
    np.testing.assert_allclose(frames(negated), frames(model), atol=1e-6)


def test_scale_rotation_and_translation_apply_in_that_order() -> None:
    """A node's matrix is T · R · S."""
    model = square(rotation=[0, 0, HALF, HALF], scale=[2, 1, 1], translation=[5, 0, 0])
    model.animate(0, "translation", [0, 1], [[5, 0, 0], [5, 0, 0]])
    np.testing.assert_allclose(
        frames(model)[3], np.add(turned(90, np.multiply(SQUARE, [2, 1, 1])), [5, 0, 0]), atol=1e-6
    )


def test_a_child_moves_with_its_parents_and_their_matrices() -> None:
    """World = parent's world · own, whether given as a matrix or as its parts."""
    model = moving_square()
    matrix = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 7, 0, 1]
    model.json["nodes"].append({"children": [0], "matrix": matrix})
    model.json["scenes"] = [{"nodes": [1]}]
    np.testing.assert_allclose(frames(model)[10], np.multiply(np.add(SQUARE, [1, 3.5, 0]), 2), atol=1e-6)


def test_steps_hold_until_the_next_key() -> None:
    """STEP: the value of the last key at or before the time."""
    model = square()
    model.animate(0, "translation", [0, 0.5, 1], [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "STEP")
    np.testing.assert_allclose(frames(model)[:, 0, 0], [0] * 5 + [1] * 5 + [2], atol=1e-6)


def test_cubic_splines_follow_hermite_with_tangents_times_the_interval() -> None:
    """Over two seconds from 0 to 1 with out-tangent 1/s and in-tangent 0: the polynomial of appendix C."""
    model = square()
    keys = [[[0, 0, 0], [0, 0, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0], [0, 0, 0]]]
    model.animate(0, "translation", [0, 2], np.reshape(keys, (6, 3)), "CUBICSPLINE")
    s = np.arange(21) / 20
    expected = (s**3 - 2 * s**2 + s) * 2 + (3 * s**2 - 2 * s**3)
    np.testing.assert_allclose(frames(model)[:, 0, 0], expected, atol=1e-6)


def test_cubic_rotations_are_normalised() -> None:
    """Without tangents, half way between two quaternions is their normalised sum."""
    model = square()
    keys = [[np.zeros(4), q, np.zeros(4)] for q in QUARTER_TURN]
    model.animate(0, "rotation", [0, 1], np.reshape(keys, (6, 4)), "CUBICSPLINE")
    np.testing.assert_allclose(frames(model)[5], turned(45), atol=1e-6)


def test_before_the_first_and_after_the_last_key_a_channel_holds() -> None:
    """Times outside the keys are clamped; frame 0 is at 0 s, whenever the first key comes."""
    model = square()
    model.animate(0, "translation", [0.5, 1], [[1, 0, 0], [2, 0, 0]])
    model.animate(0, "scale", [0, 2], [[1, 1, 1], [1, 1, 1]])
    found = frames(model)[:, 0, 0]
    np.testing.assert_allclose(found[[0, 5, 10, 20]], [1, 1, 2, 2], atol=1e-6)


def test_keys_at_the_same_time_are_a_step() -> None:
    """Exporters write cuts as two keys at one time: before it the first counts, from it on the second."""
    model = square()
    model.animate(0, "translation", [0, 0.5, 0.5, 1], [[0, 0, 0], [0, 0, 0], [4, 0, 0], [4, 0, 0]])
    np.testing.assert_allclose(frames(model)[:, 0, 0], [0] * 5 + [4] * 6, atol=1e-6)


def test_normalized_integers_are_the_fractions_they_stand_for() -> None:
    """c / 32767 of 16-bit rotations, c / 255 of 8-bit weights; -128 / 127 counts as -1."""
    model = square()
    model.animate(0, "rotation", [0, 1], np.round(np.multiply(QUARTER_TURN, 32767)), dtype="int16", normalized=True)
    np.testing.assert_allclose(frames(model)[10], turned(90), atol=5e-5)
    model = square()
    model.json["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": model.accessor([[255 / 255, 0, 0]] * 4)}]
    model.animate(0, "weights", [0, 1], [-128, 127], dtype="int8", normalized=True)
    np.testing.assert_allclose(frames(model)[[0, 10], 0, 0], [-1, 1], atol=1e-6)


def test_quantized_positions_need_not_be_normalized() -> None:
    """KHR_mesh_quantization: plain integers are taken as they are; undeclared ones with a notice."""
    model = moving_square()
    padded = np.hstack([SQUARE, np.zeros((4, 1))])
    view = model.view(padded.astype("<u2").tobytes(), byteStride=8)
    model.json["accessors"][0] |= {"bufferView": view, "componentType": 5123}
    assert codes(opened(model.glb())) == {"undeclared-quantization"}
    model.json["extensionsUsed"] = model.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    assert codes(opened(model.glb())) == set()
    np.testing.assert_allclose(frames(model)[0], SQUARE, atol=1e-6)


def row(height: float) -> np.ndarray:
    """The two vertices of the strip at a height."""
    return np.array([[0, height, 0], [1, height, 0]])


def bent_row(height: float) -> np.ndarray:
    """The same, turned by 90° about the upper joint at height 1."""
    return np.add(turned(90, row(height - 1)), [0, 1, 0])


def test_two_bones_bend_a_strip() -> None:
    """Weights 1, ½ and ½, 1: the middle is the mean of both joints' places; the mesh's own node counts for nothing."""
    strip = bending_strip()
    del strip.json["animations"][0]["channels"][1]
    lower, middle, upper = row(0), (row(1) + bent_row(1)) / 2, bent_row(2)
    expected = np.concatenate([lower, middle, upper])
    np.testing.assert_allclose(frames(strip)[10], expected, atol=1e-6)
    np.testing.assert_allclose(frames(strip)[0], np.concatenate([row(0), row(1), row(2)]), atol=1e-6)


def test_morph_targets_displace_before_the_skin_moves() -> None:
    """At full weight the strip is twice as wide, then bent: the outer corner at (2, 2) goes to (-1, 3)."""
    np.testing.assert_allclose(frames(bending_strip())[10][5], [-1, 3, 0], atol=1e-6)
    np.testing.assert_allclose(frames(bending_strip())[5][1], [1.5, 0, 0], atol=1e-6)


@pytest.mark.parametrize(
    ("node", "mesh", "expected"), [({"weights": [0.5]}, [1], 0.5), ({}, [0.25], 0.25), ({}, None, 0)]
)
def test_weights_that_nothing_animates_are_the_nodes_then_the_meshs_then_0(
    node: dict[str, object], mesh: list[float] | None, expected: float
) -> None:
    """A node's own weights override those of its mesh."""
    model = moving_square()
    model.json["nodes"][0] |= node
    model.json["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": model.accessor([[0, 1, 0]] * 4)}]
    if mesh is not None:
        model.json["meshes"][0]["weights"] = mesh
    np.testing.assert_allclose(frames(model)[0], np.add(SQUARE, [0, expected, 0]), atol=1e-6)


def test_more_than_four_joints_move_a_vertex() -> None:
    """JOINTS_1 and WEIGHTS_1 count as JOINTS_0 does: here they alone have weight."""
    strip = bending_strip()
    attributes = strip.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["JOINTS_1"], attributes["WEIGHTS_1"] = attributes["JOINTS_0"], attributes["WEIGHTS_0"]
    attributes["JOINTS_0"] = strip.accessor(np.full((6, 4), 200), "uint8")
    attributes["WEIGHTS_0"] = strip.accessor(np.zeros((6, 4)))
    np.testing.assert_array_equal(frames(strip), frames(bending_strip()))


def test_weights_are_normalised_with_a_notice() -> None:
    """Weights that sum to 5 pull no further than those that sum to 1."""
    strip = bending_strip()
    weights = np.repeat([[5, 0, 0, 0], [2.5, 2.5, 0, 0], [0, 5, 0, 0]], 2, axis=0)
    strip.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = strip.accessor(weights)
    np.testing.assert_array_equal(frames(strip), frames(bending_strip()))
    assert "weights-not-normalised" in codes(opened(strip.glb()))


def test_vertices_without_weight_hang_on_their_first_joint() -> None:
    """Weights of 0 everywhere: the joint in the first slot has all."""
    strip = bending_strip()
    strip.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = strip.accessor(np.zeros((6, 4)))
    np.testing.assert_allclose(frames(strip)[10][5], [2, 2, 0], atol=1e-6)
    assert "weights-zero" in codes(opened(strip.glb()))


def test_a_skin_without_bind_matrices_is_bound_at_its_joints() -> None:
    """A missing inverse bind matrix is the identity."""
    strip = bending_strip()
    del strip.json["skins"][0]["inverseBindMatrices"]
    np.testing.assert_allclose(frames(strip)[0][5], [1, 3, 0], atol=1e-6)


def test_the_rest_shape_is_the_bind_pose_in_the_size_of_the_scene() -> None:
    """Not morphed, not bent, whatever the skeleton's own pose, and as large as the posed mesh."""
    strip = bending_strip()
    strip.json["nodes"][1]["scale"] = [3, 3, 3]
    strip.json["nodes"][2]["rotation"] = [0, 0, 1, 0]
    rest = opened(strip.glb()).rest
    assert rest is not None
    edges = np.linalg.norm(np.diff(rest, axis=0), axis=1)
    np.testing.assert_allclose(edges, 3 * np.array([1, np.sqrt(2), 1, np.sqrt(2), 1]), rtol=1e-6)


def test_sparse_accessors_replace_some_elements() -> None:
    """Of a view, and of nothing, which is all zeros."""
    model = moving_square()
    places = {"bufferView": model.view(np.array([1, 3], "<u2").tobytes()), "componentType": 5123}
    values = {"bufferView": model.view(np.array([[7, 0, 0], [8, 0, 0]], "<f4").tobytes())}
    model.json["accessors"][0]["sparse"] = {"count": 2, "indices": places, "values": values}
    np.testing.assert_allclose(frames(model)[0], [[0, 0, 0], [7, 0, 0], [1, 1, 0], [8, 0, 0]], atol=1e-6)
    del model.json["accessors"][0]["bufferView"]
    np.testing.assert_allclose(frames(model)[0], [[0, 0, 0], [7, 0, 0], [0, 0, 0], [8, 0, 0]], atol=1e-6)


def test_interleaved_attributes_are_read_by_their_stride() -> None:
    """Positions 20 bytes apart, each followed by something else."""
    model = moving_square()
    rows = np.hstack([SQUARE, np.full((4, 2), 99)]).astype("<f4")
    model.json["accessors"][0]["bufferView"] = model.view(rows.tobytes(), byteStride=20)
    np.testing.assert_allclose(frames(model)[0], SQUARE, atol=1e-6)


def test_misaligned_data_is_read_with_a_notice() -> None:
    """An offset of 1 byte is against the rules, and the numbers are there all the same."""
    model = moving_square()
    view = model.view(b"\1" + np.array(SQUARE, "<f4").tobytes())
    model.json["accessors"][0] |= {"bufferView": view, "byteOffset": 1}
    np.testing.assert_allclose(frames(model)[0], SQUARE, atol=1e-6)
    assert codes(opened(model.glb())) == {"misaligned"}


def cyclic(triangles: np.ndarray) -> list[tuple[int, ...]]:
    """Triangles from their smallest corner on."""
    return [tuple(np.roll(row, -int(np.argmin(row))).tolist()) for row in triangles]


@pytest.mark.parametrize(
    ("mode", "indices", "expected"),
    [
        (4, SQUARE_TRIANGLES, [(0, 1, 2), (0, 2, 3)]),
        (5, [0, 1, 3, 2], [(0, 1, 3), (1, 2, 3)]),
        (6, [0, 1, 2, 3], [(0, 1, 2), (0, 2, 3)]),
        (6, None, [(0, 1, 2), (0, 2, 3)]),
        (4, None, [(0, 1, 2)]),
        (4, [0, 1, 2, 3, 1], [(0, 1, 2)]),
    ],
)
def test_lists_strips_and_fans_become_triangles(
    mode: int, indices: list[int] | None, expected: list[tuple[int, ...]]
) -> None:
    """With the winding that glTF gives them, indexed or not; corners left over are dropped with a notice."""
    model = moving_square()
    primitive = model.json["meshes"][0]["primitives"][0] | {"mode": mode}
    del primitive["indices"]
    if indices is not None:
        primitive["indices"] = model.accessor(indices, "uint32")
    model.json["meshes"][0]["primitives"] = [primitive]
    animation = opened(model.glb())
    assert cyclic(animation.triangles) == expected
    assert ("corners-left-over" in codes(animation)) == (mode == 4 and (indices is None or len(indices) % 3 > 0))


def test_primitives_and_instances_follow_in_the_order_of_the_scene() -> None:
    """Depth first over nodes, then primitives, then accessors: that is what a vertex's number means."""
    model = moving_square()
    model.json["meshes"].append({"primitives": [{"attributes": {"POSITION": model.accessor(np.add(SQUARE, 50)[:3])}}]})
    model.json["nodes"] += [{"mesh": 1}, {"mesh": 0, "children": [1], "translation": [0, 0, 8]}]
    model.json["scenes"] = [{"nodes": [2, 0]}]
    animation = opened(model.glb())
    expected = [*np.add(SQUARE, [0, 0, 8]), *np.add(SQUARE, [50, 50, 58])[:3], *SQUARE]
    np.testing.assert_allclose(animation.vertices(0, 1)[0], expected, atol=1e-6)
    np.testing.assert_array_equal(animation.triangles[2:], [[4, 5, 6], [7, 8, 9], [7, 9, 10]])


def test_points_and_lines_are_left_out_with_a_notice() -> None:
    """They have no triangles."""
    model = moving_square()
    primitives = model.json["meshes"][0]["primitives"]
    primitives.append({"attributes": primitives[0]["attributes"], "mode": 1})
    animation = opened(model.glb())
    assert animation.vertex_count == 4
    assert codes(animation) == {"primitive-skipped"}


def test_a_skeleton_without_a_mesh_is_its_joints() -> None:
    """Its vertices are the joints that move, without triangles; said in a notice."""
    strip = bending_strip()
    strip.json["nodes"][0] = {}
    strip.json["nodes"].append({"translation": [0, 2, 0]})
    strip.json["nodes"][2]["children"] = [3]
    del strip.json["animations"][0]["channels"][1]
    animation = opened(strip.glb(), fps=10)
    assert animation.triangles.shape == (0, 3)
    np.testing.assert_allclose(animation.vertices(10, 11)[0], [[0, 1, 0], [-2, 1, 0]], atol=1e-6)
    assert codes(animation) == {"skeleton-only"}


def test_gltf_with_its_data_inside_or_beside_is_the_same() -> None:
    """A data: URI, a part of the same upload by its exact name, and a GLB give the same frames."""
    model = moving_square()
    expected = frames(model)
    np.testing.assert_array_equal(opened(model.gltf(), fps=10).vertices(0, 11), expected)
    model.json["buffers"] = [{"byteLength": len(model.binary), "uri": "my%20data.bin"}]
    parts = {"a.gltf": model.gltf(), "my data.bin": bytes(model.binary), "picture.png": b"\x89PNG"}
    np.testing.assert_array_equal(opened(parts, fps=10).vertices(0, 11), expected)


def test_any_blocks_are_the_same_frames() -> None:
    """Frames do not depend on the block they are drawn in."""
    animation = opened(bending_strip().glb(), fps=100)
    whole = animation.vertices(0, animation.frames)
    for size in (1, 7, 64):
        blocks = [animation.vertices(i, min(i + size, len(whole))) for i in range(0, len(whole), size)]
        np.testing.assert_array_equal(np.concatenate(blocks), whole)


def three_takes() -> Glb:
    """Takes `walk` of 1 s, `run` of 2 s and `run` of 2 s."""
    model = moving_square()
    first = model.json["animations"][0]
    sampler = {"input": model.accessor([0, 2]), "output": model.accessor([[0, 0, 0], [0, 3, 0]])}
    longer = {"samplers": [sampler], "channels": first["channels"]}
    model.json["animations"] = [{"name": "walk"} | first, {"name": "run"} | longer, {"name": "run"} | longer]
    return model


@pytest.mark.parametrize(("take", "index"), [("longest", 1), ("walk", 0), (0, 0), (2, 2), ("1", 1)])
def test_a_take_is_chosen_by_name_or_number_and_is_the_longest_unless_it_is(take: object, index: int) -> None:
    """The first of the longest ones on ties."""
    animation = opened(three_takes().glb(), take=take)
    assert animation.take.index == index
    assert animation.take.name == ["walk", "run", "run"][index]
    assert animation.take.duration_seconds == (1 if index == 0 else 2)


@pytest.mark.parametrize(
    ("take", "code", "says"),
    [("run", "ambiguous-take", "1, 2"), ("jump", "unknown-take", "0 'walk'"), (3, "unknown-take", "0 'walk'")],
)
def test_a_take_that_is_not_one_is_refused_with_what_there_is(take: object, code: str, says: str) -> None:
    """A name that two takes have is refused with their numbers."""
    with pytest.raises(ParameterError, match=says) as refused:
        opened(three_takes().glb(), take=take)
    assert refused.value.code == code


def test_nothing_animated_is_refused_with_what_was_found() -> None:
    """A static file is told apart from a file that is broken."""
    with pytest.raises(InvalidModel, match="1 meshes") as refused:
        opened(square().glb())
    assert refused.value.code == "no-animation"
