"""Geometry compressed by Draco: read by unique ids, and refused where a stream is not what its accessors count."""

import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import DracoPy
import numpy as np
import pytest

from caesura.core.errors import CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.gltf.draco.header import read_draco_counts
from tests.formats.opening import opened
from tests.glb import SQUARE, SQUARE_TRIANGLES, Glb, moving_square

EXTENSION = "KHR_draco_mesh_compression"
Mutation = Callable[[Glb], object]


def stream(points: Any = SQUARE, **options: Any) -> bytes:
    """A square as Draco has it, in the order it was given."""
    faces = np.reshape(SQUARE_TRIANGLES, (-1, 3)).astype(np.uint32)
    encoded: bytes = DracoPy.encode(
        np.asarray(points, np.float32), faces=faces, preserve_order=True, quantization_bits=14, **options
    )
    return encoded


def compressed(data: bytes | None = None, identifier: int = 0) -> Glb:
    """The moving square, its geometry compressed."""
    model = moving_square()
    primitive = model.json["meshes"][0]["primitives"][0]
    for accessor in (primitive["indices"], primitive["attributes"]["POSITION"]):
        del model.json["accessors"][accessor]["bufferView"]
    view = model.view(stream() if data is None else data)
    primitive["extensions"] = {EXTENSION: {"bufferView": view, "attributes": {"POSITION": identifier}}}
    model.json["extensionsRequired"] = [EXTENSION]
    return model


def extension(model: Glb) -> dict[str, Any]:
    found: dict[str, Any] = model.json["meshes"][0]["primitives"][0]["extensions"][EXTENSION]
    return found


def test_compressed_geometry_is_that_of_the_plain_file() -> None:
    """To the steps of its quantization, in the same order, and without a bufferView of its own."""
    animation, plain = opened(compressed().glb()), opened(moving_square().glb())
    np.testing.assert_array_equal(animation.triangles, plain.triangles)
    np.testing.assert_allclose(animation.vertices(0, 31), plain.vertices(0, 31), atol=1e-4)


def test_attributes_are_found_by_their_unique_ids() -> None:
    """And not by their place: the ids of a file may be in any order."""
    colours = np.arange(12, dtype=np.uint8).reshape(4, 3)
    data = stream(colors=colours)
    mesh = DracoPy.decode(data)
    (identifier,) = [a["unique_id"] for a in mesh.attributes if a["attribute_type"] == 0]
    (other,) = [a["unique_id"] for a in mesh.attributes if a["attribute_type"] != 0]
    np.testing.assert_allclose(opened(compressed(data, identifier).glb()).vertices(0, 1)[0], SQUARE, atol=1e-4)
    swapped = opened(compressed(data, other).glb()).vertices(0, 1)[0]
    np.testing.assert_array_equal(swapped, colours)


def test_a_real_box_is_decoded(shared: Path) -> None:
    """Positions fill the bounds that its accessor states, and its twelve triangles are closed."""
    folder = shared / "data" / "gltf" / "variants"
    model = json.loads((folder / "BoxDraco.gltf").read_text())
    model["nodes"].append({"translation": [0, 0, 0]})
    model["buffers"].append({"byteLength": 32, "uri": "keys"})
    model["bufferViews"].append({"buffer": 1, "byteLength": 32})
    model["accessors"] += [
        {"bufferView": 1, "byteOffset": 24, "componentType": 5126, "count": 2, "type": "SCALAR"},
        {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
    ]
    channel = {"sampler": 0, "target": {"node": 1, "path": "translation"}}
    model["animations"] = [{"samplers": [{"input": 3, "output": 4}], "channels": [channel]}]
    parts = {"BoxDraco.gltf": json.dumps(model).encode(), "0.bin": (folder / "0.bin").read_bytes()}
    box = opened(parts | {"keys": struct.pack("<8f", *[0] * 7, 1)})
    places = box.vertices(0, 1)[0]
    assert (box.vertex_count, len(box.triangles)) == (24, 12)
    np.testing.assert_allclose([places.min(axis=0), places.max(axis=0)], [[-0.5] * 3, [0.5] * 3], atol=1e-4)
    corners = places[box.triangles]
    volume = np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(1, abs=1e-3)


def _count(accessor: int, count: int) -> Mutation:
    return lambda model: model.json["accessors"][accessor].update(count=count)


def _strip(model: Glb) -> None:
    """Say that the two triangles were a strip of four corners."""
    model.json["meshes"][0]["primitives"][0]["mode"] = 5
    _count(1, 4)(model)


def test_a_strip_comes_out_as_triangles() -> None:
    """A stream holds triangles, whatever the file drew them as."""
    model = compressed()
    _strip(model)
    np.testing.assert_array_equal(opened(model.glb()).triangles, opened(compressed().glb()).triangles)


def _influences(model: Glb) -> None:
    """Say that the positions are joints and weights too."""
    model.json["accessors"].append({"componentType": 5121, "count": 4, "type": "VEC4"})
    both = {name: len(model.json["accessors"]) - 1 for name in ("JOINTS_0", "WEIGHTS_0")}
    model.json["meshes"][0]["primitives"][0]["attributes"].update(both)
    extension(model)["attributes"].update(dict.fromkeys(both, 0))


def _without_positions() -> Glb:
    """Its one attribute is said to be of another kind."""
    for place in range(11, 80):
        data = bytearray(stream())
        data[place] = 4
        try:
            if DracoPy.decode(bytes(data)).points is None:
                return compressed(bytes(data))
        except (DracoPy.FileTypeException, ValueError, TypeError):
            continue
    raise AssertionError


HOSTILE: list[tuple[str, Callable[[], Glb], Mutation, str]] = [
    ("no positions in the stream", _without_positions, lambda _: None, "decompression-failed"),
    ("garbage", lambda: compressed(b"garbage" * 9), lambda _: None, "decompression-failed"),
    ("an empty stream", lambda: compressed(b""), lambda _: None, "decompression-failed"),
    ("cut off", lambda: compressed(stream()[:-9]), lambda _: None, "decompression-failed"),
    ("a point cloud", lambda: compressed(DracoPy.encode(np.zeros((4, 3)))), lambda _: None, "decompression-failed"),
    ("more vertices than stated", compressed, _count(0, 3), "decompression-failed"),
    ("fewer vertices than stated", compressed, _count(0, 5), "decompression-failed"),
    ("more corners than stated", compressed, _count(1, 3), "decompression-failed"),
    ("no such attribute", lambda: compressed(identifier=7), lambda _: None, "decompression-failed"),
    ("another width", compressed, _influences, "decompression-failed"),
    ("no bufferView", compressed, lambda m: extension(m).pop("bufferView"), "invalid-gltf"),
    ("a view that is not there", compressed, lambda m: extension(m).update(bufferView=-1), "invalid-gltf"),
    ("no attributes", compressed, lambda m: extension(m).pop("attributes"), "invalid-gltf"),
    ("an id that is text", compressed, lambda m: extension(m)["attributes"].update(POSITION="0"), "invalid-gltf"),
    ("fans", compressed, lambda m: m.json["meshes"][0]["primitives"][0].update(mode=6), "invalid-gltf"),
    ("a strip of fewer corners", compressed, lambda m: (_strip(m), _count(1, 3)(m)), "decompression-failed"),
]


@pytest.mark.parametrize(("base", "mutate", "code"), [pytest.param(*row[1:], id=row[0]) for row in HOSTILE])
def test_a_stream_that_is_not_what_it_says_is_refused(base: Callable[[], Glb], mutate: Mutation, code: str) -> None:
    """By its code, and with the place of the extension in the file."""
    model = base()
    mutate(model)
    with pytest.raises(InvalidModel) as refused:
        opened(model.glb())
    assert refused.value.code == code
    assert str(refused.value.where["pointer"]).startswith("/meshes/0/primitives/0")


def test_a_bomb_is_refused_by_its_header() -> None:
    """A few bytes that promise a billion triangles are never decoded."""
    billion = bytes([0x80, 0x80, 0x80, 0x80, 4])
    bomb = b"DRACO" + struct.pack("<BBBBH", 2, 2, 1, 0, 0) + billion * 2
    assert read_draco_counts(memoryview(bomb)) == (2**30, 2**30)
    with pytest.raises(InvalidModel, match="promises 1073741824 vertices") as refused:
        opened(compressed(bomb).glb())
    assert refused.value.code == "decompression-failed"


def test_decoded_bytes_count_against_the_budget() -> None:
    """As those of any accessor."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_DECODED_BYTES"):
        opened(compressed().glb(), Limits(max_decoded_bytes=40))


def test_metadata_before_the_geometry_is_passed_over() -> None:
    """Also blocks within blocks; without an end they are refused."""
    header = b"DRACO" + struct.pack("<BBBBH", 2, 2, 1, 0, 0x8000)
    inner = b"\x01" + b"\x01n" + b"\x02vv" + b"\x00"
    metadata = b"\x01\x07" + inner + b"\x00\x01" + b"\x03sub" + inner
    assert read_draco_counts(memoryview(header + metadata + b"\x02\x04")) == (4, 2)
    for endless in (b"\xff" * 40, b"\x00" + b"\x00\x01" * 50, b"\x00\x00\xff\xff\xff\x7f"):
        with pytest.raises(ValueError, match=r"cut off|no end"):
            read_draco_counts(memoryview(header + endless))


def test_mutated_streams_never_crash() -> None:
    """Three hundred of them: a square, or an error of ours."""
    good, random = stream(), np.random.default_rng(3)
    for _ in range(300):
        data = bytearray(good)
        for place in random.integers(0, len(data), random.integers(1, 6)):
            data[place] = random.integers(256)
        try:
            opened(compressed(bytes(data)).glb()).vertices(0, 1)
        except CaesuraError as refused:
            assert refused.code in {"decompression-failed", "non-finite-data", "index-out-of-range"}  # noqa: PT017
