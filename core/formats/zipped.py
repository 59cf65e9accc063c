"""A zip, read: its glTF with what lies beside it, or its shapes as the frames of one mesh."""

import io
from collections.abc import Callable
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from core.animation import Animation
from core.errors import InvalidModel
from core.formats.notices import Notices
from core.formats.npz import check_sum, inflated, sequence
from core.formats.vertex_sequence import finite
from core.formats.zip_files import ZipFiles, told_as_zip
from core.limits import Limits
from core.parameters import Parameters

Scratch = Callable[[int], memoryview]


def member(files: ZipFiles, name: str, data: memoryview, scratch: Scratch) -> memoryview:
    """The bytes of one file: where they lie if they are stored, else inflated into `scratch`."""
    with told_as_zip():
        if not files.is_stored(name):
            return inflated(files, name, scratch(files.members[name].file_size))
        start, stop = files.place(name)
        check_sum(data[start:stop], files.members[name].CRC, name)
        return data[start:stop]


def read_shapes(
    files: ZipFiles, data: memoryview, parameters: Parameters, limits: Limits, scratch: Scratch
) -> Animation:
    """The animation of numbered OBJ or PLY files, whose vertices and faces must be the same in all.

    Raises `varying-topology` naming the file, `no-motion`, `no-mesh`, `malformed-shape` or `non-finite-data`.
    """
    names = files.shapes()
    limits.check("max_frames", len(names), "Send fewer files")
    first, triangles = _shape(files, names[0], data)
    if len(names) < 2:
        raise InvalidModel("no-motion", "The zip has one shape; a motion needs two, numbered in their names.")
    limits.check("max_vertices", len(first))
    limits.check("max_triangles", len(triangles))
    size = len(names) * first.size * 4
    limits.check("max_inflated_bytes", size, "Send fewer files")
    stored = np.frombuffer(scratch(size), np.float32).reshape(len(names), len(first), 3)
    for frame, name in enumerate(names):
        places, faces = _shape(files, name, data) if frame else (first, triangles)
        if places.shape != first.shape or not np.array_equal(faces, triangles):
            raise InvalidModel(
                "varying-topology",
                f"{name[:80]!r} has {len(places)} vertices and {len(faces)} triangles that are not those of "
                f"{names[0][:80]!r}. All frames must have the same.",
                frame=frame,
            )
        stored[frame] = places
    return sequence(stored, triangles, None, None, parameters, limits, Notices())


def _shape(files: ZipFiles, name: str, data: memoryview) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]:
    import trimesh  # noqa: PLC0415  half a second that no other format needs

    raw = bytes(member(files, name, data, lambda size: memoryview(bytearray(size))))
    try:
        options: dict[str, Any] = {"process": False, "maintain_order": True, "skip_materials": True}
        mesh = trimesh.load_mesh(io.BytesIO(raw), file_type=name[-3:].lower(), **options)
        places, faces = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.int64)
    except MemoryError:
        raise
    except Exception as wrong:  # noqa: BLE001  # a reader of free text may stumble in any way
        raise InvalidModel("malformed-shape", f"{name[:80]!r} cannot be read ({str(wrong)[:120]}).") from None
    if places.shape[1:] != (3,) or faces.shape[1:] != (3,) or not len(places) or not len(faces):
        raise InvalidModel("no-mesh", f"{name[:80]!r} has no triangles in space.")
    if faces.min() < 0 or faces.max() >= len(places):
        raise InvalidModel("index-out-of-range", f"{name[:80]!r} names vertices that it does not have.")
    if not finite(places):
        raise InvalidModel("non-finite-data", f"{name[:80]!r} has a vertex that is not at a finite place.")
    return places, faces
