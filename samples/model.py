"""The figures as files: a skeleton, what hangs on it, and one take, as GLB."""

import numpy as np
from jaxtyping import Float

from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive
from caesura.samples.body import Body
from caesura.samples.parts import Part
from caesura.samples.skeleton import BIND, HUMAN, quaternions
from caesura.samples.take import Take


def smooth_glb(body: Body, take: Take) -> bytes:
    """A skinned figure: one mesh, one skin of all joints, one animation."""
    writer = GlbWriter()
    joints = _joints(writer)
    cloth = writer.material("body", (1.0, 1.0, 1.0, 1.0), roughness=0.7)
    primitive = Primitive(
        positions=body.surface.vertices,
        triangles=body.surface.triangles,
        normals=body.surface.normals,
        colours=body.colours,
        joints=body.joints,
        weights=body.weights,
        material=cloth,
    )
    mesh = writer.mesh("body", [primitive])
    skin = writer.skin(joints, _inverse_bind())
    writer.node("figure", mesh=mesh, skin=skin)
    _animate(writer, joints, take)
    return writer.to_bytes()


def rigid_glb(parts: list[Part], take: Take) -> bytes:
    """A figure of rigid parts: every part a mesh on its joint's node, no skin."""
    writer = GlbWriter()
    joints = _joints(writer)
    colours = sorted({part.colour for part in parts})
    paint = {c: writer.material(f"paint {i}", (*c, 1.0), metallic=0.35, roughness=0.45) for i, c in enumerate(colours)}
    for part in parts:
        primitive = Primitive(part.vertices, part.triangles, normals=part.normals, material=paint[part.colour])
        mesh = writer.mesh(part.name, [primitive])
        writer.node(part.name, parent=joints[HUMAN.index(part.joint)], mesh=mesh)
    _animate(writer, joints, take)
    return writer.to_bytes()


def _joints(writer: GlbWriter) -> list[int]:
    """The skeleton's nodes, standing in the bind pose."""
    local = HUMAN.rotations(BIND)
    nodes: list[int] = []
    for joint, (name, parent) in enumerate(zip(HUMAN.names, HUMAN.parents, strict=True)):
        rotation = quaternions(local[joint][None])[0]
        above = None if parent < 0 else nodes[parent]
        nodes.append(writer.node(name, parent=above, translation=HUMAN.offsets[joint], rotation=rotation))
    return nodes


def _inverse_bind() -> Float[np.ndarray, "J 4 4"]:
    world, places = HUMAN.pose(BIND)
    matrices = np.zeros((len(places), 4, 4))
    matrices[:, :3, :3] = np.swapaxes(world, 1, 2)
    matrices[:, :3, 3] = -(matrices[:, :3, :3] @ places[:, :, None])[:, :, 0]
    matrices[:, 3, 3] = 1.0
    return matrices


def _animate(writer: GlbWriter, joints: list[int], take: Take) -> None:
    channels = [Channel(joints[0], "translation", take.seconds, take.places)]
    channels += [Channel(node, "rotation", take.seconds, r) for node, r in zip(joints, take.rotations, strict=True)]
    writer.animation("take", channels)
