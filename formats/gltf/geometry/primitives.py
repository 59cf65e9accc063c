"""The geometry of one mesh: its primitives, as triangles and what moves their vertices."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.draco.decoder import replace_draco_attributes
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.geometry.skin_weights import SkinWeights, read_skin_weights
from caesura.formats.gltf.json_object import JsonObject

TRIANGLES, STRIP, FAN = 4, 5, 6


@dataclass(frozen=True)
class PrimitiveHeader:
    """A primitive that can be used, by what its accessors say: nothing of it has been decoded yet."""

    entry: JsonObject
    mode: int
    attributes: dict[str, AccessorLayout]
    indices: AccessorLayout | None
    targets: tuple[AccessorLayout | None, ...]

    @property
    def vertices(self) -> int:
        """How many vertices there are."""
        return self.attributes["POSITION"].count

    @property
    def triangles(self) -> int:
        """How many triangles there are."""
        corners = self.vertices if self.indices is None else self.indices.count
        return corners // 3 if self.mode == TRIANGLES else max(corners - 2, 0)


@dataclass(frozen=True)
class Primitive:
    """Decoded geometry. `targets` are the displacements of morph targets; `influences` is None where rigid."""

    positions: Float[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    targets: Float[np.ndarray, "targets V 3"]
    influences: SkinWeights | None


def read_primitive_headers(document: GltfDocument, accessors: Accessors, mesh: JsonObject) -> list[PrimitiveHeader]:
    """The primitives of a mesh that have triangles, in order; the others are noted and left out.

    Raises `invalid-gltf` where their morph targets differ in number: the weights of a mesh are those of all of them.
    """
    found = (_outline(document, accessors, primitive) for primitive in mesh.entries("primitives"))
    kept = [outline for outline in found if outline is not None]
    counts = {len(outline.targets) for outline in kept} - {0}  # what has none simply stays as it is
    if len(counts) > 1:
        told = " and ".join(map(str, sorted(counts)))
        raise mesh.refusal(f"The primitives of a mesh need as many morph targets each, not {told}.", name="primitives")
    return kept


def read_primitive(document: GltfDocument, accessors: Accessors, outline: PrimitiveHeader) -> Primitive:
    """Decode a primitive."""
    vertices = outline.vertices
    document.budget.spend(len(outline.targets) * vertices * 12, outline.entry.pointer)
    targets = np.zeros((len(outline.targets), vertices, 3), np.float32)
    for number, layout in enumerate(outline.targets):
        if layout is not None:
            targets[number] = accessors.floats(layout, vertex_data=True)
    return Primitive(
        positions=accessors.floats(outline.attributes["POSITION"], vertex_data=True),
        triangles=_triangles(document, accessors, outline),
        targets=targets,
        influences=read_skin_weights(document, accessors, outline.entry, outline.attributes),
    )


def _outline(document: GltfDocument, accessors: Accessors, primitive: JsonObject) -> PrimitiveHeader | None:
    mode = primitive.whole("mode", TRIANGLES)
    if mode > FAN:
        raise primitive.refusal(f"mode must be 0 to {FAN}, not {mode}.", name="mode")
    attributes = primitive.entry("attributes")
    if mode < TRIANGLES or attributes is None or "POSITION" not in attributes:
        document.notices.add(
            "primitive-skipped", f"{primitive.pointer} has no triangles (points, lines or no positions)."
        )
        return None
    layouts = {name: accessors.layout(attributes.index(name, len(accessors), "accessors")) for name in attributes.value}
    position = layouts["POSITION"]
    indices = None
    if "indices" in primitive:
        indices = accessors.layout(primitive.index("indices", len(accessors), "accessors"))
    draco = primitive.extension("KHR_draco_mesh_compression")
    if draco is not None:
        layouts, indices = replace_draco_attributes(document, accessors, primitive, draco, layouts, indices)
        mode = TRIANGLES
    for name, layout in layouts.items():
        if layout.count != position.count:
            raise attributes.refusal(f"{name} has {layout.count} elements, POSITION {position.count}.", name=name)
        accessors.check(layout, vertex_data=True)
    _check_position(document, position)
    if indices is not None:
        accessors.check(indices, vertex_data=False)
    outline = PrimitiveHeader(primitive, mode, layouts, indices, _targets(document, accessors, primitive, position))
    if not outline.vertices or not outline.triangles:
        document.notices.add("primitive-skipped", f"{primitive.pointer} is empty.")
        return None
    return outline


def _check_position(document: GltfDocument, position: AccessorLayout) -> None:
    if position.type != "VEC3":
        raise position.entry.refusal(f"Positions must be VEC3, not {position.type}.", name="type")
    quantized = "KHR_mesh_quantization" in document.root.values("extensionsUsed")
    if position.dtype.kind != "f" and not quantized:
        document.notices.add("undeclared-quantization", "Positions are integers, and the file does not say so.")


def _targets(
    document: GltfDocument, accessors: Accessors, primitive: JsonObject, position: AccessorLayout
) -> tuple[AccessorLayout | None, ...]:
    document.limits.check("max_targets", len(primitive.values("targets")), pointer=f"{primitive.pointer}/targets")
    found: list[AccessorLayout | None] = []
    for target in primitive.entries("targets"):
        if "POSITION" not in target:
            found.append(None)
            continue
        layout = accessors.layout(target.index("POSITION", len(accessors), "accessors"))
        if layout.count != position.count or layout.type != "VEC3":
            raise target.refusal(f"The target moves {layout.count} vertices of {position.count}.", name="POSITION")
        accessors.check(layout, vertex_data=True)
        found.append(layout)
    return tuple(found)


def _triangles(document: GltfDocument, accessors: Accessors, outline: PrimitiveHeader) -> Int[np.ndarray, "T 3"]:
    corners = np.arange(outline.vertices)
    if outline.indices is not None:
        corners = _corners(accessors, outline, outline.indices)
    if outline.mode == TRIANGLES:
        if len(corners) % 3:
            document.notices.add("corners-left-over", f"{outline.entry.pointer} has corners that make no triangle.")
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    here = np.arange(outline.triangles)
    if outline.mode == FAN:
        return np.stack([corners[here + 1], corners[here + 2], np.broadcast_to(corners[0], here.shape)], axis=1)
    odd = here % 2
    return np.stack([corners[here], corners[here + 1 + odd], corners[here + 2 - odd]], axis=1)


def _corners(accessors: Accessors, outline: PrimitiveHeader, indices: AccessorLayout) -> Int[np.ndarray, "corners"]:
    if indices.dtype.kind != "u" or indices.type != "SCALAR":
        raise indices.entry.refusal("Indices must be unsigned integers.", "index-out-of-range", "componentType")
    corners = accessors.indices(indices)
    if corners.max() >= outline.vertices:
        wrong = int(np.argmax(corners >= outline.vertices))
        raise indices.entry.refusal(
            f"Index {wrong} is {corners[wrong]}, of {outline.vertices} vertices.", "index-out-of-range"
        )
    return corners
