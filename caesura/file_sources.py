"""The files that a program gives, as buffers by name: paths, open files or bytes, one or several that belong together.

Files are mapped, not read: of a file of gigabytes only what is looked at is touched.
"""

import io
import os
import stat
from collections.abc import Mapping, Sequence
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias, TypeGuard

from caesura.core.errors import UnsupportedMedia
from caesura.mapped_files import map_file

Bytes: TypeAlias = bytes | bytearray | memoryview | mmap
FileSource: TypeAlias = Bytes | str | os.PathLike[str] | BinaryIO
"""One file: its bytes, its path, or the file itself, open for reading in binary."""
FileSources: TypeAlias = FileSource | Mapping[str, FileSource] | Sequence[str | os.PathLike[str] | BinaryIO]
"""One file, or several that belong together: by name, or a list of paths and open files."""


def is_file_source(source: object) -> TypeGuard[FileSources]:
    """Whether it stands for files, and not for numbers."""
    if isinstance(source, list | tuple):
        return bool(source) and all(isinstance(part, str | os.PathLike) or _is_open_file(part) for part in source)
    return isinstance(source, Bytes | str | os.PathLike | Mapping) or _is_open_file(source)


def open_parts(source: FileSources) -> dict[str, memoryview]:
    """The buffers by name. A path or an open file is called as it is on disk, bytes have no name.

    An open file is read from where it stands and stays open. Raises OSError where there is no such file, and
    `UnsupportedMedia` for one that was opened as text.
    """
    if isinstance(source, Mapping):
        return {name: _open_part(part) for name, part in source.items()}
    if isinstance(source, list | tuple):
        return {file_name(part): _open_part(part) for part in source}
    return {file_name(source): _open_part(source)}


def file_name(source: object) -> str:
    """The name of a file without its folders; nothing where it has none."""
    given = getattr(source, "name", "") if _is_open_file(source) else source
    return os.path.basename(given) if isinstance(given, str | os.PathLike) else ""  # noqa: PTH119  of bytes too


def _is_open_file(source: object) -> TypeGuard[BinaryIO]:
    return hasattr(source, "read") and not isinstance(source, Bytes | os.PathLike)


def _open_part(source: Any) -> memoryview:
    if isinstance(source, str | os.PathLike):
        return map_file(Path(source))
    return _read_open_file(source) if _is_open_file(source) else memoryview(source)


def _read_open_file(file: Any) -> memoryview:
    """What is left of it: mapped where it is a plain file that nobody has read of yet, else read."""
    if isinstance(file, io.TextIOBase):
        raise UnsupportedMedia("unsupported-media-type", 'The file was opened as text: open it with mode "rb".')
    raw = file.raw if isinstance(file, io.BufferedReader) else file
    if isinstance(raw, io.FileIO) and stat.S_ISREG(os.fstat(raw.fileno()).st_mode) and file.tell() == 0:
        size = os.fstat(raw.fileno()).st_size
        return memoryview(mmap(raw.fileno(), 0, access=ACCESS_READ)) if size else memoryview(b"")
    content = file.read()
    if not isinstance(content, Bytes):
        raise UnsupportedMedia("unsupported-media-type", 'The file gives text: open it with mode "rb".')
    return memoryview(content)
