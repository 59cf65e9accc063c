"""An FBX as a GLB of the same scene, so that there is one way to sample, to pose and to show it."""

from caesura.core.limits import Limits
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.native.read_as_gltf import read_as_glb
from caesura.formats.native.reader_process import NativeReader

FBX = NativeReader("FBX", "ufbx", "caesura.formats.native.fbx.read_in_child:read_scene")


def convert_fbx_to_glb(data: memoryview, limits: Limits) -> GltfConversion:
    """As glTF: nodes, meshes, skins, blend shapes and every animation stack, sampled.

    Raises `BrokenContainer` (`malformed-fbx`, `reader-crashed`), `InvalidModel`, `LimitExceeded`, or
    `UnsupportedMedia("reader-missing")`.
    """
    return read_as_glb(FBX, data, limits)
