"""The headers of PC2 and MDD: frames, points and rate, and no triangles, which are in the OBJ. Light: no NumPy."""

import struct
from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.file_type import Format
from caesura.formats.point_cache.layout import (
    MDD_HEAD,
    PC2_HEAD,
    PointCacheLayout,
    mean_rate,
    rate_of_step,
    read_mdd_layout,
    read_pc2_layout,
)
from caesura.formats.takes.frame_rate import ASSUMED
from caesura.formats.upload_summary import Header, HeaderTake


def pc2_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of a PC2, at the rate that is assumed."""
    size = file.seek(0, 2)
    file.seek(0)
    layout = read_pc2_layout(file.read(PC2_HEAD.size), size, limits)
    return _header(kind, name, layout, rate_of_step(layout))


def mdd_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of an MDD, at the mean rate of its samples."""
    size = file.seek(0, 2)
    file.seek(0)
    layout = read_mdd_layout(file.read(MDD_HEAD.size), size, limits)
    ends = (file.read(4), _read_at(file, layout.start - 4))
    first, last = struct.unpack(">2f", b"".join(ends).ljust(8, b"\0"))
    return _header(kind, name, layout, mean_rate(first, last, layout.samples) or ASSUMED)


def _read_at(file: BinaryIO, place: int) -> bytes:
    file.seek(place)
    return file.read(4)


def _header(kind: Format, name: str, layout: PointCacheLayout, rate: float) -> Header:
    take = HeaderTake(0, "vertices", (layout.samples - 1) / rate, layout.samples, rate)
    return Header(kind, name, (take,), layout.points)
