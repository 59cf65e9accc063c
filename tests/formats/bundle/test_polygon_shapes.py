"""Shapes of polygons: what of an OBJ or a PLY is read, what is refused, and how long it may take."""

import struct
import time
from collections.abc import Callable

import numpy as np
import pytest

from caesura.core.errors import InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.bundle.obj import read_obj
from caesura.formats.bundle.ply import read_ply
from caesura.formats.bundle.polygon_mesh import PolygonMesh
from tests.formats.opening import codes, opened
from tests.formats.test_zip import zipped

SQUARE = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
PLACES = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
MOST_SECONDS = 2.0

Read = Callable[[bytes, Limits], PolygonMesh]


def frames(shape: bytes, kind: str = "obj") -> bytes:
    """The same shape twice, and moved between."""
    other = shape.replace(b"v 0 0 0\n", b"v 0 0 5\n", 1)
    return zipped({f"a1.{kind}": shape, f"a2.{kind}": other})


def ply(header: str, rows: bytes, form: str = "ascii") -> bytes:
    return f"ply\nformat {form} 1.0\n{header}end_header\n".encode() + rows


XYZ = "property float x\nproperty float y\nproperty float z\n"
CORNERS = "property list uchar int vertex_indices\n"
TEXT = "\n".join(" ".join(map(str, row)) for row in PLACES).encode() + b"\n"


@pytest.mark.parametrize(
    ("faces", "triangles"),
    [
        (b"f 1 2 3\nf 1 3 4\n", [[0, 1, 2], [0, 2, 3]]),
        (b"f 1 2 3 4\n", [[0, 1, 2], [0, 2, 3]]),
        (b"f 1/9/7 2/9/7 3/9/7\r\n", [[0, 1, 2]]),
        (b"f 1//7 2//7 3//7\n", [[0, 1, 2]]),
        (b"f -4 -3 -2\nv 9 9 9\nf -1 1 2\n", [[0, 1, 2], [4, 0, 1]]),
        (b"f 1 2 \\\n3\n", [[0, 1, 2]]),
        (b"usemtl a\nvn 0 0 1\ng b\nf\t1 2 3\nl 1 2\nf 1 2\n", [[0, 1, 2]]),
        (b"f 1 2 3\nf 3 1 2\nf 2 1 3\nf 1 3 4\n", [[0, 1, 2], [0, 2, 3]]),
    ],
)
def test_the_faces_of_an_obj_are_fans(faces: bytes, triangles: list[list[int]]) -> None:
    """Each around its first corner; a triangle that is there again is dropped, an edge is none."""
    assert read_obj(SQUARE + faces, Limits()).triangles().tolist() == triangles


def test_an_obj_has_the_vertices_that_it_lists() -> None:
    """Colours behind the places and a fourth number change nothing."""
    text = b"v 0 0 0 1 0 0\nv 1 0 0 1.0\nv 1e0 1 -0\nf 1 2 3\n"
    np.testing.assert_array_equal(read_obj(text, Limits()).vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0]])


@pytest.mark.parametrize("form", ["binary_little_endian", "binary_big_endian"])
def test_a_binary_ply_is_read_in_either_order_of_bytes(form: str) -> None:
    """Faces of several sizes, beside numbers and lists that are not theirs, and elements that are not read."""
    order = "<" if "little" in form else ">"
    header = (
        f"comment made by hand\nelement vertex 4\nproperty uchar red\n{XYZ}element strip 1\n"
        "property list int int strips\nelement face 2\nproperty list uchar float texcoord\n"
        f"{CORNERS}property uchar blue\nelement edge 1\nproperty int a\n"
    )
    rows = b"".join(struct.pack(f"{order}B3f", 7, *row) for row in PLACES) + struct.pack(f"{order}i3i", 3, 0, 1, 2)
    for corners in ([0, 1, 2, 3], [0, 2, 1]):
        rows += struct.pack(f"{order}B2fB{len(corners)}iB", 2, 0.5, 0.5, len(corners), *corners, 9)
    mesh = read_ply(ply(header, rows + struct.pack(f"{order}i", 3), form), Limits())
    np.testing.assert_array_equal(mesh.vertices, PLACES)
    assert mesh.triangles().tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.sizes.tolist() == [4, 3]


def test_a_ply_of_text_may_break_its_lines_anywhere() -> None:
    """Numbers are numbers."""
    data = ply(f"element vertex 4\n{XYZ}element face 1\n{CORNERS}", TEXT.replace(b"\n", b" ") + b"4 0 1\n2 3")
    assert read_ply(data, Limits()).triangles().tolist() == [[0, 1, 2], [0, 2, 3]]


FACES = f"element vertex 4\n{XYZ}element face 2\n{CORNERS}"
TWO = b"3 0 1 2\n3 0 2 3\n"
BROKEN = {
    "vertex 0 of an OBJ": (read_obj, SQUARE + b"f 0 1 2\n", "vertex 0"),
    "half a vertex": (read_obj, SQUARE + b"f 1 2 2.5\n", "whole number"),
    "a vertex that is a word": (read_obj, SQUARE + b"f 1 2 x\n", "number belongs"),
    "a corner without a vertex": (read_obj, SQUARE + b"f 1 2 /3\n", "vertex 0 or none"),
    "a vertex of two numbers": (read_obj, SQUARE + b"v 1 2\nf 1 2 3\n", "three numbers"),
    "a face without end": (read_obj, SQUARE + b"f" + b" 1 2 3" * 20_000, "letters"),
    "more faces than a PLY has": (read_ply, ply(FACES.replace("face 2", "face 3"), TEXT + TWO), "fewer rows"),
    "fewer faces than a PLY has": (read_ply, ply(FACES.replace("face 2", "face 1"), TEXT + TWO), "more rows"),
    "more vertices than a PLY has": (read_ply, ply(f"element vertex 5\n{XYZ}", TEXT), "fewer rows"),
    "a list that goes on": (read_ply, ply(FACES, TEXT + b"3 0 1 2\n9 0 2 3\n"), "fewer rows"),
    "a list of less than nothing": (read_ply, ply(FACES, TEXT + b"-3 0 1 2\n3 0 2 3\n"), "list of -3"),
    "a list of no number": (read_ply, ply(FACES, TEXT + b"nan 0 1 2\n3 0 2 3\n"), "list of nan"),
    "half a corner": (read_ply, ply(FACES, TEXT + b"3 0 1 2\n3 0 2 2.5\n"), "whole number"),
    "a plane": (read_ply, ply(FACES.replace("property float z\n", ""), TEXT), "x, y and z"),
    "a header without end": (read_ply, b"ply\nformat ascii 1.0\n" + b"comment\n" * 9000 + b"end_header\n", "header"),
    "a header of other words": (read_ply, ply("element vertex four\n", b""), "'element vertex four'"),
    "a type that is none": (read_ply, ply("element vertex 4\nproperty string x\n", b""), "'property string x'"),
    "many lists": (read_ply, ply("element face 1\n" + CORNERS * 9, b"0 " * 9), "lists"),
}


@pytest.mark.parametrize(("read", "data", "says"), BROKEN.values(), ids=BROKEN)
def test_a_broken_shape_is_refused_in_a_sentence(read: Read, data: bytes, says: str) -> None:
    """Which says what is wrong, and through the door of all files in which file."""
    with pytest.raises(InvalidModel, match=says):
        read(data, Limits())
    kind = "obj" if read is read_obj else "ply"
    with pytest.raises(InvalidModel, match=rf"^malformed-shape: 'a1\.{kind}' has ") as refused:
        opened(frames(data, kind))
    assert refused.value.code == "malformed-shape"


def test_triangles_that_are_there_twice_are_noted() -> None:
    """How many there were."""
    animation = opened(frames(SQUARE + b"f 1 2 3\n" * 9 + b"f 1 2 3 4\n"))
    assert animation.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert "triangles-repeated" in codes(animation)


SLOW = {
    "a material for every face": SQUARE + b"".join(b"usemtl m%d\nf 1 2 3\n" % i for i in range(5200)),
    "a group for every face": SQUARE + b"".join(b"o %d\ng %d\nf 1 2 3\n" % (i, i) for i in range(5000)),
    "one polygon of 8 kB": SQUARE + b"f" + b" 1 2 3 4" * 1000,
    "equal triangles": SQUARE + b"f 1 2 3\n" * 6250,
    "faces of many corners": SQUARE + (b"f" + b" 1 2 3 4" * 500 + b"\n") * 40,
    "a million letters without a line": SQUARE + b"f 1 2 3\n#" + b"/" * 10**6,
    "slashes": SQUARE + b"f 1/" + b"/" * 60_000 + b" 2 3\n",
}


@pytest.mark.parametrize("data", SLOW.values(), ids=SLOW)
def test_no_shape_takes_long(data: bytes) -> None:
    """Reading is linear, whatever the lines are."""
    began = time.process_time()
    assert opened(frames(data)).vertex_count == 4
    assert time.process_time() - began < MOST_SECONDS


@pytest.mark.parametrize(
    ("read", "data", "setting"),
    [
        (read_obj, SQUARE, "CAESURA_MAX_VERTICES"),
        (read_obj, b"f 1 2 3\n" * 4, "CAESURA_MAX_TRIANGLES"),
        (read_obj, b"f 1 2 3 1 2 3\n", "CAESURA_MAX_TRIANGLES"),
        (read_ply, ply(FACES, TEXT + TWO), "CAESURA_MAX_VERTICES"),
        (read_ply, ply(f"element face 9\n{CORNERS}", b"0 " * 9), "CAESURA_MAX_TRIANGLES"),
        (read_ply, ply(f"element face 1\n{CORNERS}", b"9 " * 10), "CAESURA_MAX_TRIANGLES"),
        (read_ply, ply("element hair 999999999999\n", b""), "CAESURA_MAX_TRIANGLES"),
    ],
)
def test_a_shape_over_a_limit_is_refused_before_it_is_built(read: Read, data: bytes, setting: str) -> None:
    """By the number of its lines and corners."""
    with pytest.raises(LimitExceeded, match=setting):
        read(data, Limits(max_vertices=3, max_triangles=3))
