"""Meshes: control points and polygons with normals, as primitives of one material each."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.core.limits import Limits
from caesura.formats.gltf.writer import Primitive
from caesura.formats.native.fbx.blend_shapes import BlendShapes
from caesura.formats.native.fbx.held_objects import held, numbers, whole_numbers
from caesura.formats.native.fbx.skin import Skin
from caesura.formats.native.finite_numbers import finite_float32

NORMAL_STEPS = 1000
"""Corners whose normals agree to so many parts of their length share a vertex."""


@dataclass(frozen=True)
class Surface:
    """The triangles of a mesh by their corners, and of each corner its control point and normal."""

    points: Float[np.ndarray, "points 3"]
    point: Int[np.ndarray, "corners"]
    normal: Float[np.ndarray, "corners 3"] | None
    triangles: Int[np.ndarray, "T 3"]
    material: Int[np.ndarray, "T"]


def read_surface(mesh: Any, limits: Limits) -> Surface | None:
    """The polygons as fans of triangles; None where it has none."""
    limits.check("max_vertices", mesh.num_vertices)
    limits.check("max_triangles", mesh.num_triangles)
    points, point = numbers(mesh.vertices).reshape(-1, 3), whole_numbers(mesh.vertex_indices)
    faces = np.array(held(mesh.faces), np.int64).reshape(-1, 2)
    holes = np.fromiter(held(mesh.face_hole), bool, len(mesh.face_hole))
    if len(holes) == len(faces):
        faces = np.where(holes[:, None], 0, faces)
    triangles, face = _fans(faces)
    if not len(triangles) or not len(points):
        return None
    points = finite_float32(points, f"The mesh {mesh.name[:80]!r}")
    inside = ((point[triangles] >= 0) & (point[triangles] < len(points))).all(axis=1)
    material = whole_numbers(mesh.face_material)
    of_face = material if len(material) == len(faces) else np.full(len(faces), -1)
    return Surface(points, point, _normals(mesh, len(point)), triangles[inside], of_face[face[inside]])


def primitives(
    surface: Surface, materials: list[int | None], skin: Skin | None, shapes: BlendShapes
) -> list[Primitive]:
    """One for each material, with vertices of its own: control points, apart where their normals differ."""
    found = []
    for number in np.unique(surface.material).tolist():
        corners = surface.triangles[surface.material == number]
        first, triangles = _shared_vertices(surface, corners)
        source = surface.point[first]
        found.append(
            Primitive(
                surface.points[source],
                triangles,
                normals=None if surface.normal is None else surface.normal[first],
                joints=None if skin is None else skin.joints[source],
                weights=None if skin is None else skin.weights[source],
                targets=shapes.targets(source, len(surface.points)),
                material=materials[number] if 0 <= number < len(materials) else None,
            )
        )
    return found


def _fans(faces: Int[np.ndarray, "F 2"]) -> tuple[Int[np.ndarray, "T 3"], Int[np.ndarray, "T"]]:
    """The corners of triangles around the first corner of each face, and the face of each."""
    first, counts = faces[:, 0], np.maximum(faces[:, 1] - 2, 0)
    face = np.repeat(np.arange(len(faces)), counts)
    step = np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts)
    hub = first[face]
    return np.stack([hub, hub + step + 1, hub + step + 2], axis=1), face


def _normals(mesh: Any, corners: int) -> Float[np.ndarray, "corners 3"] | None:
    attribute = held(mesh.vertex_normal)
    if not attribute.exists:
        return None
    values, index = numbers(attribute.values).reshape(-1, 3), whole_numbers(attribute.indices)
    if len(index) != corners or not len(values) or index.min(initial=0) < 0 or index.max(initial=0) >= len(values):
        return None
    length = np.linalg.norm(values, axis=1, keepdims=True)
    if not (np.isfinite(length).all() and (length > 0).all()):
        return None
    return np.asarray((values / length)[index])


def _shared_vertices(
    surface: Surface, corners: Int[np.ndarray, "T 3"]
) -> tuple[Int[np.ndarray, "V"], Int[np.ndarray, "T 3"]]:
    """Of each vertex one of its corners, and the triangles by vertices: corners alike in point and normal are one."""
    flat = corners.reshape(-1)
    keys = surface.point[flat]
    if surface.normal is not None:
        steps = np.round(surface.normal[flat] * NORMAL_STEPS).astype(np.int64) + NORMAL_STEPS
        for axis in range(3):
            keys = keys * (2 * NORMAL_STEPS + 1) + steps[:, axis]
    _, first, triangles = np.unique(keys, return_index=True, return_inverse=True)
    return flat[first], triangles.reshape(-1, 3)
