"""Buffer views compressed by meshoptimizer, held to its own decoder, and refused where they are broken."""

import base64
import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.meshopt.view import decode_view
from caesura.formats.kernels.meshopt_attributes import decode_attributes
from tests.formats.opening import opened
from tests.glb import SQUARE, Glb, moving_square

ROUNDED = {"OCTAHEDRAL", "QUATERNION"}


@pytest.fixture(scope="module")
def streams(oracle: Path, node: Path, tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    """Three hundred streams and what they stand for, by the library that defines them."""
    folder = tmp_path_factory.mktemp("meshopt")
    script = shutil.copy(Path(__file__).with_name("meshopt_streams.mjs"), folder)
    (folder / "node_modules").symlink_to(oracle.parent / "node_modules")
    run = subprocess.run([str(node), str(script)], check=True, capture_output=True, text=True, timeout=60)
    return [json.loads(line) for line in run.stdout.splitlines()]


def _extension(stream: dict[str, Any]) -> JsonObject:
    return JsonObject({"mode": stream["mode"], "filter": stream["filter"], "count": stream["count"],
                  "byteStride": stream["stride"]}, "/e")  # fmt: skip


def test_every_stream_is_decoded_as_its_library_does(streams: list[dict[str, Any]]) -> None:
    """Both versions, all codecs and levels, byte for byte; rounded filters within one unit in the last place."""
    assert len(streams) > 290
    for stream in streams:
        expected = np.frombuffer(base64.b64decode(stream["decoded"]), np.uint8)
        actual = np.frombuffer(
            decode_view(_extension(stream), memoryview(base64.b64decode(stream["encoded"]))), np.uint8
        )
        if stream["filter"] in ROUNDED:
            kind = "i1" if stream["stride"] == 4 else "<i2"
            assert np.abs(actual.view(kind).astype(int) - expected.view(kind)).max() <= 1, stream["filter"]
        else:
            np.testing.assert_array_equal(actual, expected, err_msg=stream["mode"])


def test_broken_streams_end_in_an_error_of_ours(streams: list[dict[str, Any]]) -> None:
    """Cut short, made longer, or with bytes changed: decoded to something of the right size, or refused."""
    random = np.random.default_rng(5)
    for stream in streams:
        good = base64.b64decode(stream["encoded"])
        for cut in (good[:-1], good + b"\0", b"", good[:1]):
            with pytest.raises(InvalidModel) as refused:
                decode_view(_extension(stream), memoryview(cut))
            assert refused.value.code == "decompression-failed"
        for _ in range(5):
            data = bytearray(good)
            for place in random.integers(0, len(data), 3):
                data[place] = random.integers(256)
            try:
                size = len(decode_view(_extension(stream), memoryview(data)))
            except CaesuraError as wrong:
                assert wrong.code == "decompression-failed"  # noqa: PT017
            else:
                assert size == stream["count"] * stream["stride"]


def literal(elements: np.ndarray) -> bytes:
    """A stream of version 1 whose bytes are all told in full: what the simplest encoder writes."""
    count, stride = elements.shape
    differences = np.diff(elements.astype(np.int64), axis=0, prepend=np.zeros((1, stride), np.int64)) & 255
    zigzag = np.where(differences & 128, ~(differences << 1), differences << 1) & 255
    out = bytearray([0xA1])
    for start in range(0, count, most := min((8192 // stride) & ~15, 256)):
        out += b"\xff" * (stride // 4) + zigzag[start : start + most].T.astype(np.uint8).tobytes()
    return bytes(out) + bytes(max(24, stride + stride // 4))


@pytest.mark.parametrize("shape", [(1, 4), (31, 12), (300, 60), (513, 256)])
def test_bytes_told_in_full_are_read(shape: tuple[int, int]) -> None:
    """Blocks of any length, without any library."""
    elements = np.random.default_rng(1).integers(0, 256, shape).astype(np.uint8)
    out = np.zeros(shape, np.uint8)
    assert decode_attributes(np.frombuffer(literal(elements), np.uint8), out)
    np.testing.assert_array_equal(out, elements)


def compressed(name: str = "EXT_meshopt_compression", **change: Any) -> Glb:
    """The moving square, its positions compressed; `change` is made to the extension."""
    model = moving_square()
    data = literal(np.asarray(SQUARE, "<f4").view(np.uint8).reshape(4, 12))
    place = model.json["bufferViews"][model.view(data)]
    packed = {**place, "mode": "ATTRIBUTES", "byteStride": 12, "count": 4, **change}
    model.json["bufferViews"].pop()
    model.json["bufferViews"][0] = {"buffer": 1, "byteLength": 48, "extensions": {name: packed}}
    model.json["buffers"] = [
        {"byteLength": len(model.binary)},
        {"byteLength": 48, "extensions": {name: {"fallback": True}}},
    ]
    model.json["extensionsRequired"] = [name]
    return model


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
def test_a_compressed_view_is_that_of_the_plain_file(name: str) -> None:
    """Under both names; the buffer that stands in for the plain bytes is never asked for."""
    plain = opened(moving_square().glb()).vertices(0, 31)
    np.testing.assert_array_equal(opened(compressed(name).glb()).vertices(0, 31), plain)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"count": 5}, "decompression-failed"),
        ({"count": 2**40}, "decompression-failed"),
        ({"count": 3, "byteStride": 16}, "decompression-failed"),
        ({"count": 8, "byteStride": 6}, "decompression-failed"),
        ({"count": 0, "byteStride": 0}, "decompression-failed"),
        ({"mode": "TRIANGLES"}, "decompression-failed"),
        ({"mode": "TRIANGLES", "count": 12, "byteStride": 4}, "decompression-failed"),
        ({"mode": "INDICES", "count": 12, "byteStride": 4, "filter": "EXPONENTIAL"}, "decompression-failed"),
        ({"filter": "QUATERNION"}, "decompression-failed"),
        ({"filter": "GZIP"}, "invalid-gltf"),
        ({"mode": "POINTS"}, "invalid-gltf"),
        ({"count": -4}, "invalid-gltf"),
        ({"count": True}, "invalid-gltf"),
        ({"byteStride": "12"}, "invalid-gltf"),
        ({"buffer": 7}, "invalid-gltf"),
        ({"byteLength": 10**6}, "out-of-bounds"),
        ({"byteOffset": -1}, "out-of-bounds"),
        ({"byteLength": 9}, "decompression-failed"),
    ],
)
def test_a_view_that_is_not_what_it_says_is_refused(change: dict[str, Any], code: str) -> None:
    """By its code, with the place of the extension."""
    with pytest.raises(InvalidModel) as refused:
        opened(compressed(**change).glb())
    assert refused.value.code == code
    assert str(refused.value.where["pointer"]).startswith("/bufferViews/0/extensions/EXT_meshopt_compression")


def test_decoded_views_count_against_the_budget() -> None:
    """A stream is small where all is alike; what comes out of it is not."""
    model = compressed(count=2**28, byteStride=4)
    model.json["bufferViews"][0]["byteLength"] = 2**30
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_DECODED_BYTES"):
        opened(model.glb(), Limits(max_decoded_bytes=2**20))


def test_no_room_is_made_for_more_than_a_stream_can_hold() -> None:
    """Of a quarter of a terabyte, said to be in a few bytes, nothing is tried."""
    model = compressed(count=2**36, byteStride=4)
    model.json["bufferViews"][0]["byteLength"] = 2**38
    with pytest.raises(InvalidModel) as refused:
        opened(model.glb(), Limits.none())
    assert refused.value.code == "decompression-failed"
