"""The header of an Alembic: that it is one. What it holds, its reader says. Light: no NumPy."""

from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.file_type import Format
from caesura.formats.upload_summary import Header


def alembic_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:  # noqa: ARG001  as all have it
    """That of an Alembic."""
    return Header(kind, name)
