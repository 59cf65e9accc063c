"""An OBJ, read: its vertices and faces. Materials, groups, normals and texture places change no vertex."""

import io
import re

import numpy as np

from caesura.core.limits import Limits
from caesura.formats.bundle.polygon_mesh import PolygonMesh, malformed_shape, numbers, whole_numbers

LONGEST_FACE = 2**16
"""Bytes of a line with a face: some ten thousand corners."""

TEXTURE_AND_NORMAL = re.compile(rb"/\S*")
"""What may stand behind the vertex of a corner, as in 7/3/5."""


def read_obj(text: bytes, limits: Limits) -> PolygonMesh:
    """The vertices and faces of the lines `v` and `f`; no other line is looked at.

    Raises `InvalidModel("malformed-shape")`, also for a face that names vertex 0, or `LimitExceeded`.
    """
    vertices: list[bytes] = []
    faces: list[bytes] = []
    sizes: list[int] = []
    before: list[int] = []
    triangles = 0
    for line in io.BytesIO(text.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")):
        if line.startswith((b"v ", b"v\t")):
            vertices.append(b" ".join(line.split(None, 4)[1:4]))
            if len(vertices) > limits.max_vertices:
                limits.check("max_vertices", len(vertices))
        elif line.startswith((b"f ", b"f\t")):
            if len(line) > LONGEST_FACE:
                raise malformed_shape(f"has a face of {len(line):,} letters; {LONGEST_FACE:,} are read")
            corners = line.split()[1:]
            faces.append(b" ".join(corners))
            sizes.append(len(corners))
            before.append(len(vertices))
            triangles += max(len(corners) - 2, 1)
            if triangles > limits.max_triangles:
                limits.check("max_triangles", triangles)
    places = numbers(b" ".join(vertices))
    named = whole_numbers(numbers(TEXTURE_AND_NORMAL.sub(b"", b" ".join(faces))))
    if len(places) != 3 * len(vertices):
        raise malformed_shape("has a vertex without three numbers")
    if len(named) != sum(sizes) or (named == 0).any():
        raise malformed_shape("has a face that names vertex 0 or none; an OBJ counts its vertices from 1")
    # A negative number counts back from the last vertex before the face.
    corner_vertices = np.where(named > 0, named - 1, named + np.repeat(np.array(before, np.int64), sizes))
    return PolygonMesh(places.reshape(-1, 3), corner_vertices, np.array(sizes, np.int64))
