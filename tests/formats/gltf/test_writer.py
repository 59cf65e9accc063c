"""The GLB writer: what it writes is what a reader finds."""

import json
import struct

import numpy as np
import pytest

from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive
from tests.formats.opening import opened

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float64)
HALVES = np.array([[0, 1, 2], [0, 2, 3]])
SECONDS = np.arange(31) / 30


def document(glb):
    """The JSON of a GLB, after checking the container's own arithmetic."""
    magic, version, length, size, kind = struct.unpack_from("<4sIII4s", glb)
    assert (magic, version, length, kind) == (b"glTF", 2, len(glb), b"JSON")
    assert size % 4 == 0
    binary, name = struct.unpack_from("<I4s", glb, 20 + size)
    assert name == b"BIN\0"
    assert 20 + size + 8 + binary == len(glb)
    return json.loads(glb[20 : 20 + size])


def sliding():
    """A square that slides along x by 3 in a second, under a node that lifts it by 1."""
    writer = GlbWriter()
    lifted = writer.node("lifted", translation=(0, 1, 0))
    node = writer.node("square", parent=lifted, mesh=writer.mesh("square", [Primitive(SQUARE, HALVES)]))
    way = np.stack([3 * SECONDS, 0 * SECONDS, 0 * SECONDS], axis=1)
    writer.animation("slide", [Channel(node, "translation", SECONDS, way)])
    return writer


def test_a_moving_mesh_is_read_back_where_it_was_put():
    """Positions, triangles, the node tree and key-frames survive the way through a file."""
    take = opened(sliding().to_bytes())
    assert take.frames == 31
    assert take.take.name == "slide"
    assert np.array_equal(take.triangles, HALVES)
    expected = SQUARE + np.array([3.0, 1.0, 0.0])
    assert np.allclose(take.vertices(30, 31)[0], expected, atol=1e-6)


def test_a_skin_moves_each_vertex_with_its_joint():
    """Joints, weights and inverse bind matrices mean what the format says: the bound half turns, the rest stays."""
    writer = GlbWriter()
    base = writer.node("base")
    tip = writer.node("tip", parent=base, translation=(0.5, 0, 0))
    weights = np.zeros((4, 4))
    weights[:, 0] = 1
    joints = np.array([[0, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0]])
    primitive = Primitive(SQUARE, HALVES, joints=joints, weights=weights)
    inverse = np.stack([np.eye(4), np.eye(4)])
    inverse[1, 0, 3] = -0.5
    writer.node("figure", mesh=writer.mesh("square", [primitive]), skin=writer.skin([base, tip], inverse))
    quarter = np.array([[0, 0, 0, 1], [0, 0, np.sqrt(0.5), np.sqrt(0.5)]])
    writer.animation("turn", [Channel(tip, "rotation", np.array([0.0, 1.0]), quarter)])
    last = opened(writer.to_bytes(), fps=10).vertices(10, 11)[0]
    assert np.allclose(last, [[0, 0, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0], [0, 1, 0]], atol=1e-6)


def test_a_morph_target_is_added_by_its_weight():
    """A target's displacements, times the animated weight, end up in the vertices."""
    writer = GlbWriter()
    up = np.tile([0.0, 0.0, 2.0], (4, 1))
    node = writer.node("square", mesh=writer.mesh("square", [Primitive(SQUARE, HALVES, targets=[up])], weights=[0.0]))
    writer.animation("rise", [Channel(node, "weights", np.array([0.0, 1.0]), np.array([0.0, 1.0]))])
    take = opened(writer.to_bytes(), fps=10)
    assert np.allclose(take.vertices(5, 6)[0], SQUARE + up / 2, atol=1e-6)


def test_bounds_are_written_where_the_format_demands_them():
    """Positions and key times carry min and max, and every view begins on a multiple of four bytes."""
    glb = document(sliding().to_bytes())
    position = glb["accessors"][glb["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    assert (position["min"], position["max"]) == ([0, 0, 0], [1, 1, 0])
    times = glb["accessors"][glb["animations"][0]["samplers"][0]["input"]]
    assert (times["min"], times["max"]) == ([0], [1])
    assert all(view["byteOffset"] % 4 == 0 for view in glb["bufferViews"])
    assert glb["scenes"][0]["nodes"] == [0]


def test_equal_arrays_are_stored_once():
    """Channels that share their key times share one accessor."""
    writer = GlbWriter()
    still = np.zeros((31, 3))
    nodes = [writer.node(name) for name in "ab"]
    writer.animation("still", [Channel(node, "translation", SECONDS, still) for node in nodes])
    assert len(document(writer.to_bytes())["accessors"]) == 2


def test_the_same_calls_give_the_same_bytes():
    """Nothing in the file depends on time or chance."""
    assert sliding().to_bytes() == sliding().to_bytes()


def test_many_vertices_get_wide_indices():
    """Index 65,535 has a meaning of its own in 16 bits, so such a mesh uses 32."""
    writer = GlbWriter()
    many = np.zeros((65_536, 3))
    writer.node("many", mesh=writer.mesh("many", [Primitive(many, np.array([[0, 1, 65_535]]))]))
    glb = document(writer.to_bytes())
    assert glb["accessors"][glb["meshes"][0]["primitives"][0]["indices"]]["componentType"] == 5125


def test_what_gltf_cannot_hold_is_refused():
    """Doubles have no component type in glTF; a caller must say what it means."""
    with pytest.raises(ValueError, match="float64"):
        GlbWriter().accessor(np.zeros((3, 3)))
