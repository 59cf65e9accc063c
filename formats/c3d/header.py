"""The header of a C3D: its markers, frames and rate. Light: no NumPy."""

from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.c3d.point_data_layout import HEAD_BYTES, read_c3d_layout
from caesura.formats.file_type import Format
from caesura.formats.upload_summary import Header, HeaderTake


def c3d_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of a C3D."""
    size = file.seek(0, 2)
    file.seek(0)
    layout = read_c3d_layout(file.read(HEAD_BYTES), size, limits)
    take = HeaderTake(0, "motion", (layout.frames - 1) / layout.rate, layout.frames, layout.rate)
    return Header(kind, name, (take,), layout.points, 0)
