"""In the reader's process: an FBX as a GLB, each step of reading in order."""

from pathlib import PureWindowsPath
from typing import Any

import ufbx

from caesura.core.errors import BrokenContainer, InvalidModel
from caesura.core.limits import Limits
from caesura.formats.gltf.writer import GlbWriter
from caesura.formats.native.fbx.blend_shapes import read_blend_shapes
from caesura.formats.native.fbx.held_objects import all_held, held
from caesura.formats.native.fbx.materials import write_materials
from caesura.formats.native.fbx.meshes import primitives, read_surface
from caesura.formats.native.fbx.nodes import SceneNode, write_nodes
from caesura.formats.native.fbx.skin import read_skin
from caesura.formats.native.fbx.takes import MorphedNode, write_takes
from caesura.formats.native.reader_answer import GlbAnswer
from caesura.formats.notices import Notices

Y_UP = ufbx.CoordinateAxes(
    right=ufbx.CoordinateAxis.POSITIVE_X, up=ufbx.CoordinateAxis.POSITIVE_Y, front=ufbx.CoordinateAxis.POSITIVE_Z
)
"""Right-handed, as glTF has it."""


def read_scene(path: str, limits: Limits, notices: Notices) -> GlbAnswer:
    """The scene in metres and Y up. Raises `BrokenContainer("malformed-fbx")`, `InvalidModel` or `LimitExceeded`."""
    scene = _load(path)
    writer = GlbWriter()
    nodes = write_nodes(writer, scene, limits)
    morphed = _write_meshes(writer, scene, nodes, limits, notices)
    moves = write_takes(writer, scene, nodes, morphed, limits, notices)
    _tell_of_point_caches(scene, moves, notices)
    return GlbAnswer(writer.to_bytes())


def _load(path: str) -> Any:
    try:
        return held(
            ufbx.load_file(
                path,
                file_format=ufbx.FileFormat.FBX,
                load_external_files=False,
                ignore_embedded=True,
                target_axes=Y_UP,
                target_unit_meters=1.0,
                space_conversion=ufbx.SpaceConversion.ADJUST_TRANSFORMS,
                handedness_conversion_axis=ufbx.MirrorAxis.X,
                geometry_transform_handling=ufbx.GeometryTransformHandling.MODIFY_GEOMETRY,
                inherit_mode_handling=ufbx.InheritModeHandling.COMPENSATE,
            )
        )
    except ufbx.OutOfMemoryError:
        raise MemoryError from None
    except ufbx.UnsupportedVersionError as wrong:
        raise InvalidModel(
            "unsupported-fbx-version", f"{wrong}: FBX 3000 to 7700 is read. Save the file as FBX 2020 (7700) or as GLB."
        ) from None
    except ufbx.UfbxError as wrong:
        raise BrokenContainer(
            "malformed-fbx", f"The FBX cannot be opened ({str(wrong)[:200]}). Export it again."
        ) from None


def _write_meshes(
    writer: GlbWriter, scene: Any, nodes: dict[int, SceneNode], limits: Limits, notices: Notices
) -> list[MorphedNode]:
    """Every mesh at every node that has it; the nodes that blend shapes move."""
    materials = write_materials(writer, scene)
    morphed: list[MorphedNode] = []
    for mesh in all_held(scene.meshes):
        surface = read_surface(mesh, limits)
        if surface is None:
            continue
        shapes = read_blend_shapes(mesh, limits)
        used = [materials.get(material.typed_id) for material in all_held(mesh.materials)]
        for node in all_held(mesh.instances):
            known = nodes.get(node.typed_id)
            if known is None:  # the root, which has no mesh in any file but a broken one
                continue
            skin = read_skin(mesh, node, notices)
            made = writer.mesh(mesh.name, primitives(surface, used, skin, shapes), weights=shapes.rest_shares())
            joints = [] if skin is None else [nodes[bone].index for bone in skin.bones]
            writer.attach_mesh(known.index, made, None if skin is None else writer.skin(joints, skin.bind))
            if shapes.offsets:
                morphed.append(MorphedNode(known.index, shapes))
    return morphed


def _tell_of_point_caches(scene: Any, moves: bool, notices: Notices) -> None:
    """Files with vertices that lie beside this one are not read: noted, or refused where nothing else moves."""
    files = [PureWindowsPath(file.filename).name for file in all_held(scene.cache_files)]
    if not files:
        return
    detail = (
        f"Vertices are stored outside the FBX, in files such as {files[0][-80:]!r}, which are not read with it. "
        "Export the animation as Alembic, or send a PC2 or MDD with the OBJ of its faces."
    )
    if not moves:
        raise InvalidModel("external-resource", detail)
    notices.add("point-cache-left-out", detail)
