"""A stage as glTF: a node for every prim above a mesh or a skeleton, a node for every joint, a skin for every mesh."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int
from pxr import UsdGeom, UsdSkel

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.writer import Channel, GlbWriter, Path, Primitive
from caesura.formats.native.finite_numbers import finite_float32
from caesura.formats.native.reader_answer import GlbAnswer
from caesura.formats.native.usd.blend_shapes import BlendTargets, read_targets
from caesura.formats.native.usd.frame_times import Clock
from caesura.formats.native.usd.materials import Materials
from caesura.formats.native.usd.meshes_and_skeletons import Bodies, Body
from caesura.formats.native.usd.transforms import Places, decompose, matrices, on_one_side

STILL = 1e-7
"""Share of a value by which it may change and stay the same: float32 knows no more."""


class NotInGltf(Exception):
    """The stage has what glTF cannot hold, such as shear."""


@dataclass(frozen=True)
class Joints:
    """The nodes of a skeleton's joints, in its order, and what takes the skeleton's space into each at its binding."""

    nodes: list[int]
    bind: Float[np.ndarray, "joints 4 4"]


def write_gltf(bodies: Bodies, clock: Clock, to_metres: Float[np.ndarray, "4 4"], limits: Limits) -> GlbAnswer:
    """The GLB; raises `NotInGltf`."""
    if any(body.mesh.GetPointsAttr().GetNumTimeSamples() > 1 for body in bodies.meshes):
        raise NotInGltf
    if any(
        body.is_skinned and body.skinning.GetSkinningMethod() != UsdSkel.Tokens.classicLinear for body in bodies.meshes
    ):
        raise NotInGltf
    scene = _GltfScene(bodies, clock, limits)
    scene.add_prims(to_metres)
    scene.add_skeletons()
    scene.add_meshes()
    scene.add_take()
    return GlbAnswer(scene.writer.to_bytes())


class _GltfScene:
    """What has been written of a stage."""

    def __init__(self, bodies: Bodies, clock: Clock, limits: Limits) -> None:
        self.writer = GlbWriter()
        self._bodies = bodies
        self._clock = clock
        self._limits = limits
        self._nodes: dict[Any, int] = {}
        self._joints: dict[Any, Joints] = {}
        self._targets: dict[int, BlendTargets] = {}

    def add_prims(self, to_metres: Float[np.ndarray, "4 4"]) -> None:
        """A node for each prim, below one that has the units and axes of the stage where these are not glTF's."""
        root = None
        if not np.allclose(to_metres, np.eye(4)):
            root = self.writer.node("stage", **_place(decompose(to_metres[None]), 0))
        places = UsdGeom.XformCache(self._clock.begin)
        for prim in self._bodies.moved_prims():
            matrix, resets = places.GetLocalTransformation(prim)
            place = _whole(decompose(matrices([matrix])))
            above = root if resets else self._nodes.get(prim.GetParent().GetPath(), root)
            self._nodes[prim.GetPath()] = self.writer.node(prim.GetName(), parent=above, **_place(place, 0))

    def add_skeletons(self) -> None:
        """A node for each joint, where it rests."""
        total = len(self._nodes)
        for skeleton in self._bodies.skeletons:
            names, topology = skeleton.GetJointOrder() or [], skeleton.GetTopology()
            total += len(names)
            self._limits.check("max_nodes", total)
            rest = _whole(decompose(matrices(skeleton.ComputeJointLocalTransforms(self._clock.begin, True))))
            if len(rest.scale) != len(names):
                raise _invalid_skin(skeleton.GetPrim(), "has joints without a place")
            nodes: list[int] = []
            for joint, name in enumerate(names):
                above = topology.GetParent(joint)
                parent = self._nodes[skeleton.GetPrim().GetPath()] if above < 0 else nodes[above]
                nodes.append(self.writer.node(str(name).rpartition("/")[2], parent=parent, **_place(rest, joint)))
            world = matrices(skeleton.GetJointWorldBindTransforms() or [])
            if len(world) != len(names) or (len(names) and not (np.abs(np.linalg.det(world)) > 0).all()):
                raise _invalid_skin(skeleton.GetPrim(), "has joints that were bound nowhere")
            self._joints[skeleton.GetPrim().GetPath()] = Joints(nodes, np.linalg.inv(world))

    def add_meshes(self) -> None:
        """Each mesh with its material, blend shapes and skin."""
        materials = Materials(self.writer)
        for body in self._bodies.meshes:
            targets = read_targets(body, self._limits)
            joints = weights = None
            if body.is_skinned:
                joints, weights = self._influences(body)
            primitive = Primitive(
                finite_float32(body.points_at(self._clock.begin), f"The mesh {str(body.prim.GetPath())[-80:]!r}"),
                body.triangles,
                joints=joints,
                weights=weights,
                targets=targets.offsets if targets else (),
                material=materials.of(body.prim),
            )
            rest = [0.0] * len(targets.offsets) if targets else ()
            mesh = self.writer.mesh(body.prim.GetName(), [primitive], weights=rest)
            node = self._nodes[body.prim.GetPath()]
            self.writer.attach_mesh(node, mesh, self._skin(body) if body.is_skinned else None)
            if targets:
                self._targets[node] = targets

    def add_take(self) -> None:
        """One animation with a key on every frame."""
        skeletons = [one for one in self._bodies.skeletons if one.GetAnimQuery()]
        joints = sum(len(one.GetJointOrder() or []) for one in skeletons)
        moving = [prim for prim in self._bodies.moved_prims() if UsdGeom.Xformable(prim).TransformMightBeTimeVarying()]
        shapes = sum(len(targets.offsets) for targets in self._targets.values())
        frames = self._clock.frames
        self._limits.check("max_node_frames", frames * (joints + len(moving)), "Export a part of the take")
        DecodeBudget(self._limits).check(frames * 4 * (10 * (joints + len(moving)) + shapes))
        names = {str(one.GetAnimQuery().GetPrim().GetName()) for one in skeletons}
        name = names.pop() if len(names) == 1 else "animation"
        channels = [*self._prim_channels(moving), *self._joint_channels(skeletons), *self._weight_channels()]
        self.writer.animation(name, channels)

    def _influences(self, body: Body) -> tuple[Int[np.ndarray, "V influences"], Float[np.ndarray, "V influences"]]:
        """The joints and weights of every point, in fours."""
        found = body.skinning.ComputeVaryingJointInfluences(body.points)
        joints, weights = np.array(found[0], np.int64), np.array(found[1], np.float64)
        if not len(joints) or len(joints) != len(weights) or len(joints) % body.points:
            raise _invalid_skin(body.prim, "has points without joints")
        if not (np.isfinite(weights).all() and ((joints >= 0) & (joints < 2**16)).all()):
            raise _invalid_skin(body.prim, "has weights or joints that are none")
        spare = ((0, 0), (0, -(len(joints) // body.points) % 4))
        return (
            np.pad(joints.reshape(body.points, -1), spare),
            np.pad(np.maximum(weights, 0).reshape(body.points, -1), spare),
        )

    def _skin(self, body: Body) -> int:
        """The joints in the mesh's own order, each with what takes the mesh into its frame."""
        skeleton = body.skeleton
        joints = self._joints[skeleton.GetPrim().GetPath()]
        order = [str(name) for name in skeleton.GetJointOrder() or []]
        wanted = [str(name) for name in body.skinning.GetJointOrder() or order]
        places = {name: place for place, name in enumerate(order)}
        if not wanted or not set(wanted) <= set(places):
            raise _invalid_skin(body.prim, "names joints that its skeleton does not have")
        used = [places[name] for name in wanted]
        bind = np.array(body.skinning.GetGeomBindTransform()) @ joints.bind[used]
        return self.writer.skin([joints.nodes[place] for place in used], bind.transpose(0, 2, 1))

    def _keys(self) -> Float[np.ndarray, "frames"]:
        return (np.arange(self._clock.frames) / self._clock.rate).astype(np.float32)

    def _prim_channels(self, moving: list[Any]) -> Iterator[Channel]:
        """The places of prims whose transforms are animated."""
        found = np.empty((len(moving), self._clock.frames, 4, 4))
        for frame in range(self._clock.frames):
            places = UsdGeom.XformCache(self._clock.code(frame))
            for row, prim in enumerate(moving):
                found[row, frame] = np.array(places.GetLocalTransformation(prim)[0])
        for row, prim in enumerate(moving):
            yield from self._place_channels(self._nodes[prim.GetPath()], found[row])

    def _joint_channels(self, skeletons: list[Any]) -> Iterator[Channel]:
        for skeleton in skeletons:
            nodes = self._joints[skeleton.GetPrim().GetPath()].nodes
            found = np.empty((self._clock.frames, len(nodes), 4, 4))
            for frame in range(self._clock.frames if nodes else 0):
                found[frame] = np.array(skeleton.ComputeJointLocalTransforms(self._clock.code(frame)))
            for joint, node in enumerate(nodes):
                yield from self._place_channels(node, found[:, joint])

    def _place_channels(self, node: int, found: Float[np.ndarray, "frames 4 4"]) -> Iterator[Channel]:
        place = _whole(decompose(found))
        yield from self._channel(node, "translation", place.translation)
        yield from self._channel(node, "rotation", on_one_side(place.rotation))
        yield from self._channel(node, "scale", place.scale)

    def _weight_channels(self) -> Iterator[Channel]:
        for node, targets in self._targets.items():
            shares = np.array([targets.shares(self._clock.code(frame)) for frame in range(self._clock.frames)])
            yield from self._channel(node, "weights", shares)

    def _channel(self, node: int, path: Path, values: Float[np.ndarray, "frames numbers"]) -> Iterator[Channel]:
        """One key where the values never change."""
        keys = self._keys()
        if (np.abs(values - values[0]) <= STILL * np.abs(values).max(initial=1e-30)).all():
            keys, values = keys[:1], values[:1]
        flat = values.astype(np.float32)
        yield Channel(node, path, keys, flat.reshape(-1) if path == "weights" else flat)


def _whole(places: Places) -> Places:
    """Raise where translation, rotation and scale do not hold what the matrices do."""
    if places.sheared:
        raise NotInGltf
    if not all(np.isfinite(values).all() for values in (places.translation, places.rotation, places.scale)):
        raise InvalidModel("non-finite-data", "A transform of the USD puts something where nothing can be.")
    return places


def _place(places: Places, row: int) -> dict[str, Any]:
    """One place as the writer takes it."""
    return {
        "translation": places.translation[row], "rotation": places.rotation[row], "scale": places.scale[row],
    }  # fmt: skip


def _invalid_skin(prim: Any, what: str) -> InvalidModel:
    return InvalidModel("invalid-skin", f"The skin of {str(prim.GetPath())[-80:]!r} {what}. Export the file again.")
