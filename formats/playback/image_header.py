"""What an image is, by its first bytes: its media type and its size in pixels. It is never decoded here."""

import struct
from dataclasses import dataclass

PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
FRAME_HEADERS = frozenset({*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC})
"""Markers of a JPEG after which its size stands (ITU-T T.81, table B.1)."""


@dataclass(frozen=True)
class ImageHeader:
    """The media type, and width and height in pixels."""

    media_type: str
    width: int
    height: int


def read_image_header(data: memoryview) -> ImageHeader | None:
    """The header of a PNG, a JPEG or a WebP; None for anything else, and for one that is cut off."""
    try:
        first = bytes(data[:12])
        if first.startswith(PNG):
            return ImageHeader("image/png", *struct.unpack(">II", data[16:24]))
        if first.startswith(JPEG):
            return _jpeg(data)
        if first.startswith(b"RIFF") and first.endswith(b"WEBP"):
            return _webp(data)
    except (struct.error, IndexError):
        pass
    return None


def _jpeg(data: memoryview) -> ImageHeader | None:
    """Steps from segment to segment until the header of a frame."""
    at = 2
    while at < len(data):
        marker, length = data[at + 1], int.from_bytes(data[at + 2 : at + 4], "big")
        if data[at] != 0xFF or length < 2:
            return None
        if marker in FRAME_HEADERS:
            height, width = struct.unpack(">HH", data[at + 5 : at + 9])
            return ImageHeader("image/jpeg", width, height)
        at += 2 + length
    return None


def _webp(data: memoryview) -> ImageHeader | None:
    """The size of a lossy, a lossless or an extended file (RFC 9649, section 2)."""
    kind = bytes(data[12:16])
    if kind == b"VP8X":
        sides = (1 + int.from_bytes(data[at : at + 3], "little") for at in (24, 27))
        return ImageHeader("image/webp", *sides)
    if kind == b"VP8L":
        (bits,) = struct.unpack("<I", data[21:25])
        return ImageHeader("image/webp", 1 + (bits & 0x3FFF), 1 + (bits >> 14 & 0x3FFF))
    if kind == b"VP8 ":
        width, height = struct.unpack("<HH", data[26:30])
        return ImageHeader("image/webp", width & 0x3FFF, height & 0x3FFF)
    return None
