"""The meshes and skeletons of a stage, and what the library computes of them."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from jaxtyping import Float, Int
from pxr import Usd, UsdGeom, UsdSkel

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.native.usd.layer import malformed

SEEN = {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}
"""Purposes of what is rendered, and no guide or proxy of it."""


@dataclass(frozen=True)
class Body:
    """A mesh. With `skinning` it is bound to the skeleton that `skeleton` knows."""

    mesh: Any
    points: int
    triangles: Int[np.ndarray, "T 3"]
    skeleton: Any = None
    skinning: Any = None

    @property
    def prim(self) -> Any:
        """The prim of the mesh."""
        return self.mesh.GetPrim()

    @property
    def is_skinned(self) -> bool:
        """Whether joints move its points."""
        return self.skinning is not None and self.skinning.HasJointInfluences()

    @property
    def is_blended(self) -> bool:
        """Whether blend shapes move its points."""
        return self.skinning is not None and self.skinning.HasBlendShapes()

    def points_at(self, code: float) -> Float[np.ndarray, "V 3"]:
        """Its points as they are stored; raises `varying-topology` where they are not as many as at first."""
        found = numbers(self.mesh.GetPointsAttr(), code, np.float64).reshape(-1, 3)
        if len(found) != self.points:
            raise InvalidModel(
                "varying-topology",
                f"The mesh {str(self.prim.GetPath())[-80:]!r} has {len(found)} points at time code {code:g} and "
                f"{self.points} at first. A surface that is made anew, such as a liquid, cannot be cut.",
            )
        return found


@dataclass(frozen=True)
class Bodies:
    """The meshes of a stage, its skeletons, and how many prims of other kinds there are. They live as long as it."""

    stage: Any
    meshes: list[Body] = field(default_factory=list)
    skeletons: list[Any] = field(default_factory=list)
    others: Counter[str] = field(default_factory=Counter)

    def samples(self) -> Iterator[list[float]]:
        """The time codes of everything that moves a mesh or a skeleton."""
        for body in self.meshes:
            yield body.mesh.GetPointsAttr().GetTimeSamples()
        for skeleton in self.skeletons:
            animation = skeleton.GetAnimQuery()
            if animation:
                yield animation.GetJointTransformTimeSamples() or []
                yield animation.GetBlendShapeWeightTimeSamples() or []
        for prim in self.moved_prims():
            if UsdGeom.Xformable(prim).TransformMightBeTimeVarying():
                yield UsdGeom.Xformable(prim).GetTimeSamples()

    def moved_prims(self) -> list[Any]:
        """All meshes and skeletons and what is above them, parents first, each once."""
        found: dict[Any, Any] = {}
        for owner in [*(body.prim for body in self.meshes), *(skeleton.GetPrim() for skeleton in self.skeletons)]:
            chain, prim = [], owner
            while prim and not prim.IsPseudoRoot() and prim.GetPath() not in found:
                chain.append(prim)
                prim = prim.GetParent()
            found |= {above.GetPath(): above for above in reversed(chain)}
        return list(found.values())


def numbers(attribute: Any, code: Any, kind: type[Any]) -> np.ndarray[Any, Any]:
    """The numbers of an attribute at a time, in one row; raises `malformed-usd` where it has something else."""
    value = attribute.Get(code)
    try:
        return np.array([] if value is None else value, kind).reshape(-1)
    except (TypeError, ValueError):
        raise malformed(f"{attribute.GetPath()} has no numbers") from None


def read_bodies(stage: Any, limits: Limits) -> Bodies:
    """All that is seen; raises `InvalidModel` or `LimitExceeded`."""
    cache = UsdSkel.Cache()
    every = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
    bound = dict(_skinned_meshes(stage, cache, every))
    found = Bodies(stage)
    points = triangles = 0
    for seen, prim in enumerate(stage.Traverse(every)):
        limits.check("max_nodes", seen + 1)
        if prim.IsA(UsdSkel.Skeleton):
            found.skeletons.append(cache.GetSkelQuery(UsdSkel.Skeleton(prim)))
        elif prim.IsA(UsdGeom.Mesh) and _is_seen(prim):
            body = _read_mesh(UsdGeom.Mesh(prim), *bound.get(prim.GetPath(), (None, None)))
            points, triangles = points + body.points, triangles + len(body.triangles)
            limits.check("max_vertices", points)
            limits.check("max_triangles", triangles)
            if len(body.triangles):
                found.meshes.append(body)
        else:
            found.others[str(prim.GetTypeName()) or "prim of no type"] += 1
    return found


def _skinned_meshes(stage: Any, cache: Any, every: Any) -> Iterator[tuple[Any, tuple[Any, Any]]]:
    """The paths of meshes that are bound to a skeleton, each with the queries of both."""
    for prim in stage.Traverse(every):
        if not prim.IsA(UsdSkel.Root):
            continue
        root = UsdSkel.Root(prim)
        cache.Populate(root, every)
        for binding in cache.ComputeSkelBindings(root, every):
            skeleton = cache.GetSkelQuery(binding.GetSkeleton())
            for skinning in binding.GetSkinningTargets():
                yield skinning.GetPrim().GetPath(), (skeleton, skinning)


def _is_seen(prim: Any) -> bool:
    imageable = UsdGeom.Imageable(prim)
    hidden = imageable.ComputeVisibility(Usd.TimeCode.EarliestTime()) == UsdGeom.Tokens.invisible
    return not hidden and imageable.ComputePurpose() in SEEN


def _read_mesh(mesh: Any, skeleton: Any, skinning: Any) -> Body:
    earliest = Usd.TimeCode.EarliestTime()
    points = len(numbers(mesh.GetPointsAttr(), earliest, np.float64)) // 3
    faces = numbers(mesh.GetFaceVertexCountsAttr(), earliest, np.int64)
    corners = numbers(mesh.GetFaceVertexIndicesAttr(), earliest, np.int64)
    name = str(mesh.GetPrim().GetPath())[-80:]
    if (faces < 0).any() or faces.sum() > len(corners) or ((corners < 0) | (corners >= points)).any():
        raise InvalidModel("index-out-of-range", f"The mesh {name!r} names corners or points that it does not have.")
    if any(
        attribute.GetNumTimeSamples() > 1 and attribute.ValueMightBeTimeVarying()
        for attribute in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
    ) and not _same_faces(mesh, faces, corners):
        raise InvalidModel(
            "varying-topology", f"The faces of the mesh {name!r} change. A surface that is made anew cannot be cut."
        )
    first, counts = np.cumsum(faces) - faces, np.maximum(faces - 2, 0)
    face = np.repeat(np.arange(len(faces)), counts)
    step = np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts)
    hub = first[face]
    triangles = corners[np.stack([hub, hub + step + 1, hub + step + 2], axis=1)]
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        triangles = triangles[:, ::-1]
    return Body(mesh, points, triangles, skeleton, skinning)


def _same_faces(mesh: Any, faces: Int[np.ndarray, "F"], corners: Int[np.ndarray, "corners"]) -> bool:
    """Whether a mesh has the same faces at every one of their samples."""
    return all(
        np.array_equal(numbers(attribute, code, np.int64), first)
        for attribute, first in ((mesh.GetFaceVertexCountsAttr(), faces), (mesh.GetFaceVertexIndicesAttr(), corners))
        for code in attribute.GetTimeSamples()
    )
