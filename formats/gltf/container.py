"""The outer shape of a glTF: one GLB, or JSON. Light: no NumPy."""

import struct
from typing import NamedTuple

from caesura.core.errors import BrokenContainer, InvalidModel
from caesura.core.limits import Limits
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.strict_json import parse_json_object
from caesura.formats.notices import Notices

MAGIC = b"glTF"
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
MOST_CHUNKS = 16
HEADER, CHUNK = struct.Struct("<4sII"), struct.Struct("<II")

AGAIN = "Export or upload the file again."


class Container(NamedTuple):
    """The JSON of a glTF, and the binary chunk of a GLB."""

    root: JsonObject
    binary: memoryview | None
    is_glb: bool


def open_container(data: memoryview, limits: Limits, notices: Notices) -> Container:
    """Read the container of a glTF 2.0 (glTF 2.0 specification, section 4.4).

    Raises `BrokenContainer` (`malformed-glb`, `malformed-json`), `LimitExceeded`, or `InvalidModel`
    (`unsupported-gltf-version`).
    """
    if data[:4] != MAGIC:
        root = parse_root(data, limits)
        return Container(root, None, is_glb=False)
    text, binary = _chunks(data, notices)
    return Container(parse_root(text, limits), binary, is_glb=True)


def glb_length(head: bytes | memoryview, available: int) -> int:
    """The length that the 12-byte header of a GLB states, which must be `available` at least."""
    if len(head) < HEADER.size:
        raise _malformed("ends within its header")
    _, version, length = HEADER.unpack_from(head)
    if version != 2:
        raise InvalidModel("unsupported-gltf-version", f"The file is GLB version {version}; export it as glTF 2.0.")
    if length > available:
        raise _malformed(f"states a length of {length:,} bytes and has {available:,}: it is cut off")
    if length < HEADER.size + CHUNK.size:
        raise _malformed(f"states a length of {length} bytes, too few for any content")
    return int(length)


def json_chunk_length(head: bytes | memoryview, room: int) -> int:
    """The length of the first chunk, of whose 8-byte header `head` consists; `room` bytes follow it."""
    length, kind = CHUNK.unpack_from(head)
    if kind != JSON_CHUNK:
        raise _malformed("does not begin with a chunk of JSON")
    if not 0 < length <= room:
        raise _malformed(f"has a chunk of {length:,} bytes with {room:,} left")
    return int(length)


def check_version(root: JsonObject) -> None:
    """Raise unless the file is glTF 2.x and can be read by a reader of 2.0."""
    asset = root.value.get("asset")
    version = asset.get("version") if isinstance(asset, dict) else None
    least = asset.get("minVersion", "2.0") if isinstance(asset, dict) else "2.0"
    if _numbers(version)[:1] == (2,) and (0,) < _numbers(least) <= (2, 0):
        return
    stated = f"version {str(version)[:20]!r}" if version is not None else "no version"
    needs = f" and needs at least {str(least)[:20]!r}" if least != "2.0" else ""
    raise InvalidModel(
        "unsupported-gltf-version", f"The file states {stated}{needs}; glTF 2.0 is read here.", pointer="/asset/version"
    )


def _numbers(version: object) -> tuple[int, ...]:
    parts = version.split(".") if isinstance(version, str) and len(version) <= 20 else []
    return tuple(int(part) for part in parts) if len(parts) == 2 and all(p.isdecimal() for p in parts) else ()


def parse_root(text: bytes | memoryview, limits: Limits) -> JsonObject:
    """The root of the JSON, which must be glTF 2.0."""
    advice = "Send it as a GLB without data in its JSON"
    limits.check("max_json_bytes", len(text), advice)
    root = JsonObject(parse_json_object(text), "")
    check_version(root)
    return root


def _chunks(data: memoryview, notices: Notices) -> tuple[memoryview, memoryview | None]:
    length = glb_length(data[: HEADER.size], len(data))
    if length < len(data):
        notices.add("extra-data", f"{len(data) - length:,} bytes after the end of the GLB were ignored.")
    end = HEADER.size + CHUNK.size + json_chunk_length(data[HEADER.size :], length - HEADER.size - CHUNK.size)
    text, binary = data[HEADER.size + CHUNK.size : end], None
    for _ in range(MOST_CHUNKS):
        if end == length:
            return text, binary
        if length - end < CHUNK.size:
            raise _malformed("ends within the header of a chunk")
        size, kind = CHUNK.unpack_from(data, end)
        start, end = end + CHUNK.size, end + CHUNK.size + size
        if end > length:
            raise _malformed(f"has a chunk of {size:,} bytes with {length - start:,} left")
        if kind == JSON_CHUNK or (kind == BINARY_CHUNK and binary is not None):
            raise _malformed("has two chunks of the same kind")
        if kind == BINARY_CHUNK:
            binary = data[start:end]
    raise _malformed(f"has more than {MOST_CHUNKS} chunks")


def _malformed(what: str) -> BrokenContainer:
    return BrokenContainer("malformed-glb", f"The GLB {what}. {AGAIN}")
