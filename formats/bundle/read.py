"""A zip, read: its glTF with what lies beside it, or its shapes as the frames of one mesh."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Int

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.bundle.polygon_mesh import Surface, read_obj, read_ply
from caesura.formats.bundle.zip_members import ZipMembers, errors_as_zip
from caesura.formats.notices import Notices
from caesura.formats.npz.read import inflate_member, verify_checksum, vertex_sequence_from_arrays
from caesura.formats.vertex_sequence import require_finite

Scratch = Callable[[int], memoryview]


def read_member(files: ZipMembers, name: str, data: memoryview, scratch: Scratch) -> memoryview:
    """The bytes of one file: where they lie if they are stored, else inflated into `scratch`."""
    with errors_as_zip():
        if not files.is_stored(name):
            return inflate_member(files, name, scratch(files.members[name].file_size))
        start, stop = files.place(name)
        verify_checksum(data[start:stop], files.members[name].CRC, name)
        return data[start:stop]


def read_shapes(
    files: ZipMembers, data: memoryview, parameters: Parameters, limits: Limits, scratch: Scratch
) -> Animation:
    """The animation of numbered OBJ or PLY files, whose vertices and faces must be the same in all.

    Raises `varying-topology` naming the file, `no-motion`, `no-mesh`, `malformed-shape`, `index-out-of-range` or
    `non-finite-data`.
    """
    names = files.shapes()
    limits.check("max_frames", len(names), "Send fewer files")
    first, faces = _read_shape(files, names[0], data, limits)
    if len(names) < 2:
        raise InvalidModel("no-motion", "The zip has one shape; a motion needs two, numbered in their names.")
    notices = Notices()
    triangles = drop_repeated_triangles(faces, notices)
    size = len(names) * first.size * 4
    limits.check("max_inflated_bytes", size, "Send fewer files")
    stored = np.frombuffer(scratch(size), np.float32).reshape(len(names), len(first), 3)
    for frame, name in enumerate(names):
        vertices, found = _read_shape(files, name, data, limits) if frame else (first, faces)
        if vertices.shape != first.shape or not np.array_equal(found, faces):
            raise InvalidModel(
                "varying-topology",
                f"{name[:80]!r} has {len(vertices)} vertices and {len(found)} triangles that are not those of "
                f"{names[0][:80]!r}. All frames must have the same.",
                frame=frame,
            )
        stored[frame] = vertices
        if not require_finite(stored[frame]):
            raise InvalidModel("non-finite-data", f"{name[:80]!r} has a vertex that is not at a finite place.")
    return vertex_sequence_from_arrays(stored, triangles, None, None, parameters, limits, notices)


def _read_shape(files: ZipMembers, name: str, data: memoryview, limits: Limits) -> Surface:
    raw = bytes(read_member(files, name, data, lambda size: memoryview(bytearray(size))))
    read = read_obj if name.lower().endswith(".obj") else read_ply
    try:
        vertices, triangles = read(raw, limits)
    except InvalidModel as wrong:
        raise InvalidModel(wrong.code, f"{name[:80]!r} {wrong.detail}. Export it again.") from None
    if not len(vertices) or not len(triangles):
        raise InvalidModel("no-mesh", f"{name[:80]!r} has no triangles in space.")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise InvalidModel("index-out-of-range", f"{name[:80]!r} names vertices that it does not have.")
    return vertices, triangles


def drop_repeated_triangles(triangles: Int[np.ndarray, "T 3"], notices: Notices) -> Int[np.ndarray, "U 3"]:
    """Of triangles with the same three corners, the first."""
    first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)[1]
    if repeated := len(triangles) - len(first):
        notices.add("triangles-repeated", f"{repeated} triangles have the same corners as others, and count once.")
    return np.asarray(triangles[np.sort(first)])
