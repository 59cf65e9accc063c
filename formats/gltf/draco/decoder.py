"""Geometry compressed by Draco (KHR_draco_mesh_compression): decoded whole, one stream a primitive."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NoReturn

import DracoPy
import numpy as np
from jaxtyping import Shaped

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.draco.header import read_draco_counts
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.json_object import JsonObject

TRIANGLES, STRIP = 4, 5


@dataclass(frozen=True)
class DracoStream:
    """One compressed primitive. `vertices` and `corners` are what its accessors count: so many must come out."""

    entry: JsonObject
    data: memoryview
    vertices: int
    corners: int

    @cached_property
    def mesh(self) -> "DracoPy.DracoMesh":
        """All that is in it, decoded once; raises `decompression-failed`."""
        try:
            points, faces = read_draco_counts(self.data)
            if points > self.vertices or 3 * faces != self.corners:
                self.fail(f"promises {points} vertices and {faces} triangles")
            mesh = DracoPy.decode(bytes(self.data))
        except (DracoPy.FileTypeException, ValueError, RuntimeError, TypeError, IndexError, OverflowError) as wrong:
            self.fail(f"cannot be decoded ({str(wrong)[:120]})")
        points = 0 if mesh.points is None else len(mesh.points)  # None where no attribute is a position
        if points != self.vertices or np.size(getattr(mesh, "faces", ())) != self.corners:
            self.fail(f"holds {points} vertices")
        return mesh

    def attribute(self, unique_id: int, layout: AccessorLayout) -> Shaped[np.ndarray, "count width"]:
        """The attribute of that id, in the kind of number that its accessor states."""
        found = next((a["data"] for a in self.mesh.attributes if a["unique_id"] == unique_id), None)
        if found is None or np.shape(found) != (layout.count, layout.width):
            self.fail(f"has no attribute {unique_id} of {layout.count} {layout.type}")
        values = np.asarray(found)
        if layout.dtype.kind != "f":
            bounds = np.iinfo(layout.dtype.name)
            if not ((values >= bounds.min) & (values <= bounds.max)).all():
                self.fail(f"has an attribute {unique_id} that {layout.dtype} cannot hold")
        return np.ascontiguousarray(values, layout.dtype)

    def triangles(self, layout: AccessorLayout) -> Shaped[np.ndarray, "count 1"]:
        """The corners of all triangles."""
        return np.asarray(self.mesh.faces).reshape(layout.count, 1)

    def fail(self, what: str) -> NoReturn:
        """Raise `decompression-failed`, for whatever reason."""
        raise InvalidModel(
            "decompression-failed",
            f"The compressed geometry {what}, where its accessors count {self.vertices} vertices and {self.corners} "
            "corners. Export the file again.",
            pointer=self.entry.pointer,
        )


def replace_draco_attributes(
    document: GltfDocument,
    accessors: Accessors,
    primitive: JsonObject,
    extension: JsonObject,
    attributes: dict[str, AccessorLayout],
    indices: AccessorLayout | None,
) -> tuple[dict[str, AccessorLayout], AccessorLayout | None]:
    """The layouts of a compressed primitive, with those that lie in its stream made to come from there.

    What comes out are triangles, also where the file counts the corners of a strip. Attributes are found by the unique
    ids that the extension gives; one that it does not name has data of its own.
    """
    mode = primitive.whole("mode", TRIANGLES)
    if indices is None or mode not in (TRIANGLES, STRIP):
        raise extension.refusal("Compressed geometry must be indexed triangles.")
    data = accessors.view(extension.index("bufferView", len(document.views), "buffer views"))
    corners = indices.count if mode == TRIANGLES else _corners_of_strip(data, indices.count)
    stream = DracoStream(extension, data, attributes["POSITION"].count, corners)
    named = extension.entry("attributes")
    if named is None or "POSITION" not in named:
        raise extension.refusal("POSITION is not among the compressed attributes.", name="attributes")
    found = {
        name: _from_stream(layout, stream, named.whole(name)) if name in named else layout
        for name, layout in attributes.items()
    }
    # Draco makes 32-bit corners of any.
    return found, replace(indices, count=corners, dtype=np.dtype("<u4"), unpack=stream.triangles)


def _corners_of_strip(data: memoryview, corners: int) -> int:
    """Corners of the triangles that a strip of so many corners was compressed as; those without area may be missing."""
    try:
        _, faces = read_draco_counts(data)
    except ValueError:
        return corners  # told when it is decoded
    return 3 * faces if faces <= max(corners - 2, 0) else corners


def _from_stream(layout: AccessorLayout, stream: DracoStream, unique_id: int) -> AccessorLayout:
    return replace(layout, unpack=lambda wanted: stream.attribute(unique_id, wanted))
