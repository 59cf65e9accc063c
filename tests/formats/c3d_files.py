"""Writes C3D files as the processors did that the format was made on: the twin of what reads them."""

import struct
from collections.abc import Mapping, Sequence

import numpy as np

INTEL, DEC, SGI = 84, 85, 86
Value = str | Sequence[str] | Sequence[int] | float


def c3d(
    places: np.ndarray,
    *,
    processor: int = INTEL,
    scale: float = -1.0,
    hidden: np.ndarray | None = None,
    rate: float = 100.0,
    first: int = 1,
    analog: int = 0,
    more: Mapping[tuple[str, str], Value] | None = None,
) -> bytes:
    """Places (frames, markers, 3) in the unit of the file. A positive `scale` stores integers of places / scale."""
    frames, points, _ = places.shape
    order = ">" if processor == SGI else "<"
    parameters = {("POINT", "UNITS"): "mm", ("POINT", "LABELS"): [f"m{i}" for i in range(points)][:255]} | dict(
        more or {}
    )
    section = _parameters(parameters, processor)
    start = 2 + len(section) // 512
    head = struct.pack(f"{order}BBHHHHH", 2, 0x50, points, analog, first, min(first + frames - 1, 65_535), 10)
    head += real(scale, processor) + struct.pack(f"{order}HH", start, 1) + real(rate, processor)
    residual = np.zeros((frames, points)) if hidden is None else np.where(hidden, -1.0, 0.0)
    numbers = np.concatenate([places / (scale if scale > 0 else 1.0), residual[:, :, None]], axis=2)
    row = np.concatenate([numbers.reshape(frames, -1), np.full((frames, analog), 7.0)], axis=1)
    if scale > 0:
        data = np.round(row).astype(f"{order}i2").tobytes()
    else:
        data = b"".join(reals(values, processor) for values in row)
    return head.ljust(512, b"\0") + section + data


def real(value: float, processor: int) -> bytes:
    """One real; of a DEC the IEEE number of four times as much, its halves exchanged."""
    if processor == DEC:
        ieee = struct.pack("<f", value * 4)
        return ieee[2:] + ieee[:2]
    return struct.pack(">f" if processor == SGI else "<f", value)


def reals(values: np.ndarray, processor: int) -> bytes:
    """Many of them."""
    return b"".join(real(float(value), processor) for value in values)


def _parameters(values: Mapping[tuple[str, str], Value], processor: int) -> bytes:
    order = ">" if processor == SGI else "<"
    groups = list(dict.fromkeys(group for group, _ in values))
    out = bytearray()
    for number, group in enumerate(groups, 1):
        out += struct.pack("<bb", len(group), -number) + group.encode() + struct.pack(f"{order}H", 3) + b"\0"
    for (group, name), value in values.items():
        body = _value(value, processor) + b"\0"
        out += struct.pack("<bb", -len(name), groups.index(group) + 1) + name.encode()  # locked
        out += struct.pack(f"{order}H", len(body) + 2) + body
    out += bytes(4)
    blocks = -(-(len(out) + 4) // 512)
    return (struct.pack("<BBBB", 1, 0x50, blocks, processor) + out).ljust(512 * blocks, b"\0")


def _value(value: Value, processor: int) -> bytes:
    order = ">" if processor == SGI else "<"
    if isinstance(value, str):
        return struct.pack("<bBB", -1, 1, len(value)) + value.encode()
    if isinstance(value, float):
        return struct.pack("<bB", 4, 0) + real(value, processor)
    if isinstance(value[0], str):
        width = max(len(str(text)) for text in value)
        return struct.pack("<bBBB", -1, 2, width, len(value)) + b"".join(str(t).encode().ljust(width) for t in value)
    return struct.pack(f"{order}bBB{len(value)}H", 2, 1, len(value), *value)
