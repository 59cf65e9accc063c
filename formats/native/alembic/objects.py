"""The meshes of an archive, and the transforms above them."""

from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from alembic3d import Abc, AbcGeom
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.native.alembic.samples import SampledProperty, nearest_sample, sampled

HIDDEN = 0
KINDS = {"PolyMesh": AbcGeom.IPolyMesh, "SubD": AbcGeom.ISubD}


@dataclass(frozen=True)
class Transform:
    """A transform above meshes: its matrix, for rows, and whether that of its parent comes after it."""

    matrix: SampledProperty
    parent: "Transform | None"

    def to_world(self, second: float) -> Float[np.ndarray, "4 4"]:
        """From the space of what is below to that of the scene."""
        found = self.matrix.at(second)
        above = self.parent
        while above is not None:
            found = found @ above.matrix.at(second)
            above = above.parent
        return found


@dataclass(frozen=True)
class Mesh:
    """A mesh: its positions, its triangles, and the transform above it."""

    name: str
    positions: SampledProperty
    triangles: Int[np.ndarray, "T 3"]
    vertices: int
    above: Transform | None

    def properties(self) -> list[SampledProperty]:
        """All that moves it."""
        found, above = [self.positions], self.above
        while above is not None:
            found.append(above.matrix)
            above = above.parent
        return found

    def world_positions(self, second: float) -> Float[np.ndarray, "V 3"]:
        """Its vertices in the scene at a time."""
        positions = self.positions.at(second)
        if self.above is None:
            return positions
        matrix = self.above.to_world(second)
        return np.asarray(positions @ matrix[:3, :3] + matrix[3, :3])


def read_meshes(archive: Any, limits: Limits) -> list[Mesh]:
    """All meshes that are not hidden for good, in order; raises `no-mesh` saying what there is instead."""
    found: list[Mesh] = []
    kinds: Counter[str] = Counter()
    waiting: list[tuple[Any, Transform | None]] = [(archive.getTop(), None)]
    seen = 0
    while waiting:
        entry, above = waiting.pop()
        seen += 1
        limits.check("max_nodes", seen)
        header = entry.getHeader()
        if _is_hidden(entry):
            kinds["hidden object"] += 1
            continue
        if AbcGeom.IXform.matches(header):
            above = _read_transform(entry, above, limits)
        kind = next((name for name, known in KINDS.items() if known.matches(header)), None)
        if kind is not None:
            mesh = _read_mesh(
                KINDS[kind](entry.getParent(), header.getName()).getSchema(), header.getName(), above, limits
            )
            limits.check("max_vertices", sum(one.vertices for one in found) + mesh.vertices)
            limits.check("max_triangles", sum(len(one.triangles) for one in found) + len(mesh.triangles))
            found.append(mesh)
        elif seen > 1:
            kinds[_kind(entry)] += 1
        children = [(entry.getChild(number), above) for number in range(entry.getNumChildren())]
        waiting += reversed(children)
    if not any(len(mesh.triangles) for mesh in found):
        listed = ", ".join(f"{count} {name}" for name, count in kinds.items()) or "nothing"
        raise InvalidModel(
            "no-mesh", f"The Alembic has no mesh with polygons; it has {listed}. Export the animated surface."
        )
    return found


def _kind(entry: Any) -> str:
    """What an object is, by the name of its schema, such as AbcGeom_Camera_v1."""
    schema = str(entry.getMetaData().get("schema"))
    return schema.removeprefix("AbcGeom_").rpartition("_")[0][:40] or "object of no kind"


def _is_hidden(entry: Any) -> bool:
    """Whether it says that it and all below are never seen."""
    properties = entry.getProperties()
    names = [properties.getPropertyHeader(number).getName() for number in range(properties.getNumProperties())]
    if "visible" not in names or not properties.getPropertyHeader("visible").isScalar():
        return False
    visible = Abc.ICharProperty(properties, "visible")
    return bool(visible.isConstant() and visible.getNumSamples() and visible.getValue(Abc.ISampleSelector()) == HIDDEN)


def _read_transform(entry: Any, above: Transform | None, limits: Limits) -> Transform:
    schema = AbcGeom.IXform(entry.getParent(), entry.getHeader().getName()).getSchema()

    def read(second: float) -> Float[np.ndarray, "4 4"]:
        matrix = schema.getValue(nearest_sample(second)).getMatrix()
        return np.array([[float(x) for x in row] for row in matrix])

    inherits = schema.getInheritsXforms(Abc.ISampleSelector())
    return Transform(sampled(schema, schema.isConstant(), read, limits), above if inherits else None)


def _read_mesh(schema: Any, name: str, above: Transform | None, limits: Limits) -> Mesh:
    positions, counts, indices = (
        schema.getPositionsProperty(), schema.getFaceCountsProperty(), schema.getFaceIndicesProperty(),
    )  # fmt: skip
    first = Abc.ISampleSelector()
    expected = len(positions.getValue(first))
    corners, faces = np.array(indices.getValue(first), np.int64), np.array(counts.getValue(first), np.int64)
    fixed = counts.isConstant() and indices.isConstant()

    def read(second: float) -> Float[np.ndarray, "V 3"]:
        selector = nearest_sample(second)
        values = np.array(positions.getValue(selector), np.float32).reshape(-1, 3)
        same = fixed or (
            np.array_equal(np.array(indices.getValue(selector)), corners)
            and np.array_equal(np.array(counts.getValue(selector)), faces)
        )
        if len(values) != expected or not same:
            raise InvalidModel(
                "varying-topology",
                f"The mesh {name[:80]!r} has {len(values)} vertices at {second:.3f} s and {expected} at first, or has "
                "other faces. A surface that is made anew, such as a liquid, cannot be cut: bake it onto one mesh.",
            )
        return values

    moving = sampled(positions, positions.isConstant(), read, limits)
    return Mesh(name, moving, _triangles(faces, corners, expected, name), expected, above)


def _triangles(
    faces: Int[np.ndarray, "F"], corners: Int[np.ndarray, "corners"], vertices: int, name: str
) -> Int[np.ndarray, "T 3"]:
    """Fans around the first corner of each face, the other way round than Alembic has them."""
    if (faces < 0).any() or faces.sum() > len(corners):
        raise InvalidModel(
            "index-out-of-range", f"The faces of the mesh {name[:80]!r} have more corners than there are."
        )
    if ((corners < 0) | (corners >= vertices)).any():
        raise InvalidModel("index-out-of-range", f"The mesh {name[:80]!r} names vertices that it does not have.")
    first = np.cumsum(faces) - faces
    counts = np.maximum(faces - 2, 0)
    face = np.repeat(np.arange(len(faces)), counts)
    step = np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts)
    hub = first[face]
    return np.asarray(corners[np.stack([hub, hub + step + 2, hub + step + 1], axis=1)])
