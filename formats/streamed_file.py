"""A file that is written piece by piece. Light: no NumPy."""

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class StreamedFile:
    """A file: its media type, and its content, to be read once, while the upload is still there."""

    media_type: str
    pieces: Iterator[bytes]
