"""The header of a USD: that it is one. What it holds, its reader says. Light: no NumPy."""

from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.file_type import Format
from caesura.formats.upload_summary import Header


def usd_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:  # noqa: ARG001  as all have it
    """That of a USD."""
    return Header(kind, name)
