"""The model as its author made it: materials and images reach the page, and faulty ones keep no take from playing."""

import base64
import json
import struct
import zlib

import numpy as np
import pytest

from caesura.formats.playback.image_header import ImageHeader, read_image_header
from caesura.formats.playback.playable_gltf import write_playable_gltf
from tests.glb import Glb, bending_strip


def png(width: int, height: int) -> bytes:
    """A red image."""
    rows = b"".join(b"\0" + b"\xff\0\0" * width for _ in range(height))
    parts = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(rows)),
        (b"IEND", b""),
    )
    chunks = (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def painted(**material: object) -> Glb:
    """A strip with a material of one image, texture coordinates and colours."""
    model = bending_strip()
    primitive = model.json["meshes"][0]["primitives"][0]
    primitive["material"] = 1
    primitive["attributes"] |= {
        "TEXCOORD_0": model.accessor([[0, 0]] * 6),
        "COLOR_0": model.accessor([[255, 0, 0, 255]] * 6, "uint8", normalized=True),
    }
    model.json |= {
        "images": [{"bufferView": model.view(png(2, 3)), "mimeType": "image/png"}],
        "samplers": [{"wrapS": 33071}],
        "textures": [{"source": 0, "sampler": 0}],
        "materials": [{}, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, **material}],
    }
    return model


def document(data: bytes) -> dict:
    """The JSON of a GLB."""
    return json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])


def copies(model: Glb, **beside: bytes) -> tuple[dict, bytes | None]:
    """The JSON of the plain copy, and the file of the materials."""
    parts = {"": memoryview(model.glb()), **{name: memoryview(data) for name, data in beside.items()}}
    plain, whole = write_playable_gltf(parts, 0, np.zeros(6, np.int64))
    return document(b"".join(plain)), None if whole is None else b"".join(whole)


def test_a_material_reaches_the_page_and_its_image_follows() -> None:
    """The plain copy has colours and where images lie; the other file has the same materials with the image itself."""
    model = painted(doubleSided=True, alphaMode="MASK", alphaCutoff=0.25, extensions={"KHR_materials_unlit": {}})
    plain, whole = copies(model)
    primitive = plain["meshes"][0]["primitives"][0]
    assert {"TEXCOORD_0", "COLOR_0"} <= primitive["attributes"].keys()
    assert primitive["material"] == 0
    (material,) = plain["materials"]
    assert (material["doubleSided"], material["alphaMode"], material["alphaCutoff"]) == (True, "MASK", 0.25)
    assert material["extensions"] == {"KHR_materials_unlit": {}}
    assert "baseColorTexture" not in material["pbrMetallicRoughness"]
    assert whole is not None
    images = document(whole)
    assert images["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] == {"index": 0, "texCoord": 0}
    assert images["textures"] == [{"source": 0, "sampler": 0}]
    assert images["samplers"] == [{"wrapS": 33071}]
    view = images["bufferViews"][images["images"][0]["bufferView"]]
    start = len(whole) - images["buffers"][0]["byteLength"] + view["byteOffset"]
    assert whole[start : start + view["byteLength"]] == png(2, 3)


def test_an_image_beside_the_model_or_in_its_json_is_found() -> None:
    """By its name, and as a data: URI."""
    for uri in ("skin.png", "data:image/png;base64," + base64.b64encode(png(2, 3)).decode()):
        model = painted()
        model.json["images"] = [{"uri": uri}]
        _, whole = copies(model, **{"skin.png": png(2, 3)})
        assert whole is not None
        assert document(whole)["images"][0]["mimeType"] == "image/png"


@pytest.mark.parametrize(
    "fault",
    [
        {"materials": [{}, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 7}}}]},
        {"materials": [{}, {"pbrMetallicRoughness": {"baseColorFactor": "red"}}]},
        {"materials": []},
        {"textures": [{"source": 9}]},
        {"textures": [{}]},
        {"images": [{"bufferView": 99}]},
        {"images": [{"uri": "elsewhere.png"}]},
        {"images": [{"uri": "data:image/png;base64,????"}]},
        {"samplers": [{"wrapS": "x"}]},
    ],
)
def test_a_faulty_material_is_left_out(fault: dict) -> None:
    """The take is played without it."""
    model = painted()
    model.json |= fault
    plain, whole = copies(model)
    assert len(plain["animations"]) == 1
    assert whole is None


def test_an_image_larger_than_is_shown_is_left_out() -> None:
    """By what its header says, before anything is decoded."""
    model = painted()
    huge = bytearray(png(1, 1))
    huge[16:24] = struct.pack(">II", 60_000, 60_000)
    model.json["images"] = [{"bufferView": model.view(bytes(huge))}]
    assert copies(model)[1] is None


@pytest.mark.parametrize(
    ("data", "found"),
    [
        (png(5, 7), ImageHeader("image/png", 5, 7)),
        (
            b"\xff\xd8\xff\xe0\0\x04ab\xff\xc2\0\x0b\x08\0\x09\0\x05" + bytes(20),
            ImageHeader("image/jpeg", 5, 9),
        ),
        (b"RIFF\0\0\0\0WEBPVP8X\n\0\0\0\0\0\0\0\x04\0\0\x08\0\0", ImageHeader("image/webp", 5, 9)),
        (
            b"RIFF\0\0\0\0WEBPVP8L\0\0\0\0\x2f" + struct.pack("<I", 4 | 8 << 14),
            ImageHeader("image/webp", 5, 9),
        ),
        (b"RIFF\0\0\0\0WEBPVP8 " + bytes(10) + struct.pack("<HH", 5, 9), ImageHeader("image/webp", 5, 9)),
        (png(5, 7)[:18], None),
        (b"\xff\xd8\xff\xe0\0\x04ab", None),
        (b"\xff\xd8\xff\xe0\0\0" + bytes(20), None),
        (b"GIF89a", None),
        (b"", None),
    ],
)
def test_an_image_says_what_it_is(data: bytes, found: ImageHeader | None) -> None:
    """The media type and the size in pixels, of each kind; nothing where it is cut off or unknown."""
    assert read_image_header(memoryview(data)) == found
