"""An OBJ or a PLY, checked and then read by trimesh: vertices and triangles. Nothing else of it is looked at.

What trimesh reads slowly, or accepts and should not, is refused before: it gets lines of one form, bounded in number.
"""

import io
import re
import warnings
from itertools import pairwise
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits

Surface = tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]

LONGEST_FACE = 2**16
"""Bytes of a line with a face: some ten thousand corners."""

VERTEX_OR_FACE = re.compile(rb"^[vf][ \t].*", re.MULTILINE)
TEXTURE_AND_NORMAL = re.compile(rb"(?<=\d)/\S*")
"""What may stand behind the vertex of a corner, as in 7/3/5."""
COUNTED_BACK = re.compile(rb"-(\d{1,9})(?!\S)")
CORNERS = re.compile(rb"(?:\s+0*[1-9]\d{0,8}(?!\S))*\s*")

LONGEST_HEADER, MOST_PROPERTIES = 2**16, 32
READ_PROPERTIES = {"x", "y", "z", "vertex_index", "vertex_indices"}


def read_obj(text: bytes, limits: Limits) -> Surface:
    """The vertices and faces of the lines `v` and `f`, each face as a fan around its first corner.

    Raises `InvalidModel("malformed-shape")`, also for a face that names vertex 0, or `LimitExceeded`.
    """
    vertices: list[bytes] = []
    faces: list[bytes] = []
    for line in VERTEX_OR_FACE.findall(text.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")):
        if line.startswith(b"v"):
            vertices.append(b" ".join(line.split(None, 4)[:4]))
            continue
        if len(line) > LONGEST_FACE:
            raise malformed_shape(f"has a face of {len(line):,} letters; {LONGEST_FACE:,} are read")
        # A negative number counts back from the last vertex before the face.
        named = TEXTURE_AND_NORMAL.sub(b"", line[1:])
        if b"-" in named:
            named = COUNTED_BACK.sub(lambda back: b"%d" % (len(vertices) + 1 - int(back[1])), named)
        if not CORNERS.fullmatch(named):
            raise malformed_shape(
                "has a face that names vertex 0 or no whole number; an OBJ counts its vertices from 1"
            )
        hub, *corners = named.split() or [b""]
        faces += [b"f %b %b %b" % (hub, *pair) for pair in pairwise(corners)]
        if len(faces) > limits.max_triangles:
            break
    limits.check("max_vertices", len(vertices))
    limits.check("max_triangles", len(faces))
    return _read(b"\n".join(vertices + faces), "obj")


def read_ply(data: bytes, limits: Limits) -> Surface:
    """The vertices and faces of a file in ASCII or binary. Faces of several sizes are read in ASCII only.

    Raises `InvalidModel("malformed-shape")`, also where there are more or fewer rows than the header says, or
    `LimitExceeded`.
    """
    end = data.find(b"end_header", 0, LONGEST_HEADER)
    start = data.find(b"\n", end) + 1
    if not data.startswith(b"ply") or end < 0 or not start:
        raise malformed_shape("has no header of a PLY")
    header = [line.split() for line in data[:end].decode("latin1").splitlines()]
    if sum(words[:1] == ["property"] for words in header) > MOST_PROPERTIES:
        raise malformed_shape(f"has more than {MOST_PROPERTIES} properties")
    rows = 0
    for number, words in enumerate(header):
        match words:
            case ["element", name, count] if re.fullmatch(r"[0-9]{1,15}", count):
                rows += int(count)
                limits.check("max_vertices" if name == "vertex" else "max_triangles", int(count))
                words[1] = name if name in {"vertex", "face"} else f"other{number}"
            case ["element", *_]:
                raise malformed_shape(f"has {' '.join(words)[:60]!r} in its header")
            case ["property", *_, name] if name not in READ_PROPERTIES:
                words[-1] = f"other{number}"  # textures and edges would split vertices
    # trimesh compares a binary file with its header, by the length.
    if ["format", "ascii"] in (words[:2] for words in header) and rows != len(data[start:].rstrip().splitlines()):
        raise malformed_shape("has more or fewer rows than its header says")
    lines = [" ".join(words) for words in header if words[:1] not in ([], ["comment"], ["obj_info"])]
    vertices, triangles = _read("\n".join([*lines, "end_header\n"]).encode() + data[start:], "ply")
    limits.check("max_triangles", len(triangles))
    return vertices, triangles


def _read(data: bytes, kind: str) -> Surface:
    import trimesh  # noqa: PLC0415  no other format needs it

    options: dict[str, Any] = {"process": False, "maintain_order": True, "skip_materials": True}
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", category=DeprecationWarning)  # as NumPy calls a number that is none
            mesh: Any = trimesh.load(io.BytesIO(data), file_type=kind, **options)
            mesh = mesh.to_mesh() if isinstance(mesh, trimesh.Scene) else mesh
    except (
        ArithmeticError,
        AttributeError,
        LookupError,
        NameError,
        TypeError,
        ValueError,
        DeprecationWarning,
    ) as fault:
        raise malformed_shape(f"has something that cannot be read ({str(fault)[:120]})") from None
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(getattr(mesh, "faces", ()), np.int64)
    if vertices.shape[1:] != (3,):
        raise malformed_shape("has a vertex without three numbers")
    return vertices, triangles.reshape(-1, 3)


def malformed_shape(what: str) -> InvalidModel:
    """The refusal of a shape, whose name the caller puts before it."""
    return InvalidModel("malformed-shape", what)
