"""What the fuzzer begins with: models of the project's own making, every format and every feature of it, small."""

import zipfile
from collections.abc import Iterator

import numpy as np

from caesura.core.limits import Limits
from caesura.formats.bundle.polygon_mesh import read_obj
from caesura.formats.bvh.gltf_conversion import convert_bvh_to_glb
from caesura.worker.process.warm_up import example_gltf
from tests.formats import test_hostile_npz as archives
from tests.formats.bundle import test_polygon_shapes as polygons
from tests.formats.c3d_files import DEC, INTEL, SGI, c3d
from tests.formats.gltf import test_hostile_gltf as hostile
from tests.formats.gltf.test_draco import compressed
from tests.formats.gltf.test_instances import instanced
from tests.formats.gltf.test_mesh_and_motion import mesh, skeleton
from tests.formats.gltf.test_vrm_animation import waving
from tests.formats.native import fbx_text
from tests.formats.native.fbx_binary import binary
from tests.formats.point_caches import MESH, folding_sheet, mdd, pc2
from tests.formats.test_asf import ASF, amc
from tests.formats.test_body_poses import amass
from tests.formats.test_bvh import ARM
from tests.formats.test_npz import npz
from tests.formats.test_zip import SHAPE, separate, shapes, zipped
from tests.fuzz import bodies, labels
from tests.fuzz.mutations import NAMES
from tests.fuzz.parts import joined
from tests.glb import Glb, bending_strip, moving_square, square

OBJ = (
    b"v 0 0 0\nv 1 0 0\nv 1 1 0 1\nv 0 1 0 .5 .5 .5\nvt 0 0\nvn 0 0 1\no a\ng b\nusemtl c\n"
    b"f 1/1/1 2/1/1 3//1 -1\nl 1 2\n"
)
PLY = (
    b"ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty double y\n"
    b"property int z\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nelement edge 1\n"
    b"property list int int ends\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 7\n3 0 2 1 7\n2 0 1\n"
)

LARGEST = 64 * 2**10
"""Bytes of a seed, and of what is made of it: faults are in structure, not in size."""


def seeds() -> list[bytes]:
    """All of them, none larger than `LARGEST`, each once."""
    return list(dict.fromkeys(data for data in _all() if len(data) <= LARGEST))


def _all() -> Iterator[bytes]:
    yield from (bytes(data) for data in _good())
    yield from _uploads()
    for base, rows in (
        (
            moving_square,
            hostile.STRUCTURE
            + hostile.ACCESSORS
            + hostile.GEOMETRY
            + hostile.GRAPH
            + hostile.ANIMATIONS
            + hostile.RESOURCES,
        ),
        (bending_strip, hostile.SKINS),
    ):
        for _, mutate, *_ in rows:
            yield _mutated(base(), mutate)
    yield from (_mutated(moving_square(), mutate) for _, mutate, _ in hostile.ODD[1:])
    yield from (data for _, data, _ in [*hostile.CONTAINERS, *archives.FAULTS])
    yield from bodies.seeds()
    yield from labels.seeds()
    yield from (zipped({name: SHAPE, "a2.obj": SHAPE}) for name in NAMES)
    for read, data, _ in polygons.BROKEN.values():
        yield polygons.frames(data, "obj" if read is read_obj else "ply")
    yield from (polygons.frames(data) for data in polygons.SLOW.values())


def _good() -> Iterator[bytes]:
    for model in (moving_square(), bending_strip(), _splines(), _strips(), _sparse(), _two_takes(), _skeleton()):
        yield model.glb()
        yield model.gltf()
    yield waving().glb()
    yield compressed().glb()
    yield instanced(TRANSLATION=([[0, 0, 0], [0, 5, 0]], "float32"), SCALE=([[1, 1, 1], [2, 2, 2]], "float32")).glb()
    yield _packed().glb()
    yield example_gltf()
    yield npz()
    yield amass(np.ones((3, 72)))
    yield amass(np.ones((3, 52, 3)), mocap_frame_rate=np.float32(30))
    yield npz(deflate=True, frame_rate=25.0, rest=np.zeros((5, 3)))
    yield npz(vertices=np.asfortranarray(archives.FRAMES.astype(">f8")))
    yield npz(vertices=archives.FRAMES.astype("f2"), triangles=archives.TRIANGLES.astype("u1"))
    yield ARM.encode()
    for made in (fbx_text.moving_square(), fbx_text.bending_strip(), fbx_text.blending_square()):
        yield made.data()
        yield binary(made.data())
    yield bytes(convert_bvh_to_glb(memoryview(ARM.encode()), Limits()).glb)
    for processor in (INTEL, DEC, SGI):
        yield c3d(np.ones((3, 4, 3)), processor=processor, analog=2, more={("TRIAL", "ACTUAL_END_FIELD"): [3, 0]})
    yield c3d(np.ones((60, 2, 3)), scale=0.5, rate=30.0, hidden=np.arange(120).reshape(60, 2) % 7 == 0)
    yield zipped(separate())
    yield zipped(separate(), zipfile.ZIP_STORED)
    yield zipped({"export/arm.bvh": ARM.encode()})
    yield zipped(shapes("obj", 3))
    yield zipped({f"a{i}.obj": OBJ.replace(b"0", b"%d" % i, 1) for i in range(2)})
    yield zipped({f"a{i}.ply": PLY.replace(b"0 0 0", b"0 0 %d" % i) for i in range(2)})
    yield zipped(shapes("ply", 3), zipfile.ZIP_STORED)


def _uploads() -> Iterator[bytes]:
    yield joined(separate())
    yield joined({"mesh.glb": mesh().glb(), "motion.glb": skeleton().glb()})
    yield joined({"mesh.gltf": mesh().gltf(), "motion.gltf": skeleton().gltf()})
    yield joined({"arm.amc": amc(), "arm.asf": ASF.encode()})
    yield zipped({"arm.amc": amc(head=":SAMPLES-PER-SECOND 60"), "arm.asf": ASF.encode()})
    yield joined({"a.pc2": pc2(folding_sheet(3)), "a.obj": MESH})
    yield joined({"a.mdd": mdd(folding_sheet(3), np.arange(3) / 24), "a.obj": MESH})
    yield zipped({"a.mdd": mdd(folding_sheet(3), np.arange(3) / 24), "a.obj": MESH}, zipfile.ZIP_STORED)
    yield joined({"mesh.glb": mesh().glb(), "arm.bvh": ARM.replace("Hips", "lower").encode()})


def _mutated(model: Glb, mutate: hostile.Mutation) -> bytes:
    mutate(model)
    return model.glb()


def _splines() -> Glb:
    model = square()
    turns = np.tile([[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]], (2, 1))
    model.animate(0, "rotation", [0, 1], turns, "CUBICSPLINE")
    model.animate(0, "scale", [0, 0.5, 0.5, 2], np.ones((4, 3)), "STEP")
    model.animate(0, "translation", [0.5, 1], np.eye(3)[:2])
    return model


def _strips() -> Glb:
    model = moving_square()
    one = model.json["meshes"][0]["primitives"][0]
    strip = {**one, "mode": 5, "indices": model.accessor([0, 1, 3, 2], "uint8")}
    fan = {"mode": 6, "attributes": one["attributes"]}
    quantized = model.accessor(np.array([[0, 0, 0, 0], [9, 0, 0, 0], [0, 9, 0, 0]]), "int16")
    model.json["accessors"][quantized] |= {"type": "VEC3", "normalized": True}
    model.json["bufferViews"][model.json["accessors"][quantized]["bufferView"]]["byteStride"] = 8
    model.json["extensionsUsed"] = ["KHR_mesh_quantization"]
    model.json["meshes"][0]["primitives"] += [strip, fan, {"attributes": {"POSITION": quantized}}, {**one, "mode": 0}]
    return model


def _sparse() -> Glb:
    model = moving_square()
    zeros = {"componentType": 5126, "count": 4, "type": "VEC3"}
    zeros["sparse"] = {
        "count": 2,
        "indices": {"bufferView": model.view(np.array([1, 3], "<u2").tobytes()), "componentType": 5123},
        "values": {"bufferView": model.view(np.ones((2, 3), "<f4").tobytes())},
    }
    model.json["accessors"].append(zeros)
    mesh = model.json["meshes"][0]
    mesh["primitives"][0]["targets"] = [{"POSITION": len(model.json["accessors"]) - 1}, {}]
    mesh["weights"] = [0.5, 0.25]
    model.animate(0, "weights", [0, 1], [[0, 1], [1, 0]])
    return model


def _two_takes() -> Glb:
    model = bending_strip()
    model.json["animations"].append({**model.json["animations"][0], "name": "again"})
    model.json["nodes"][0]["skin"] = 0
    model.json["nodes"].append({"matrix": np.eye(4).ravel().tolist(), "mesh": 0})
    model.json["nodes"][1]["children"].append(3)
    return model


def _skeleton() -> Glb:
    model = skeleton()
    model.json["scenes"].append({"nodes": []})
    return model


def _packed() -> Glb:
    """Key times and index lists compressed by meshoptimizer: streams that were made once, of four elements each."""
    model = moving_square()
    fallback = {"byteLength": 64}
    model.json["buffers"] = [{"byteLength": 0}, fallback]
    attributes = bytes.fromhex("a0") + bytes(4 * 1) + bytes(28) + bytes(4)
    indices = bytes.fromhex("d1") + bytes([0, 4, 4, 4]) + bytes(4)
    for mode, count, data in (("ATTRIBUTES", 4, attributes), ("INDICES", 4, indices)):
        view = model.view(data)
        packed = {**model.json["bufferViews"][view], "mode": mode, "count": count, "byteStride": 4}
        model.json["bufferViews"].append(
            {
                "buffer": 1,
                "byteLength": 16,
                **({"byteStride": 4} if mode == "ATTRIBUTES" else {}),
                "extensions": {"EXT_meshopt_compression": packed},
            }
        )
    model.json["buffers"][0]["byteLength"] = len(model.binary)
    model.json["accessors"][1] = {"bufferView": len(model.json["bufferViews"]) - 1, "componentType": 5125,
                                  "count": 4, "type": "SCALAR"}  # fmt: skip
    return model
