"""A zip that was sent to us: its directory is judged before anything in it is opened. Light: no NumPy."""

import math
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from caesura.core.errors import BrokenContainer, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.npy_header import NpyHeader, read_npy_header

MOST_MEMBERS = 16
LONGEST_DIRECTORY = 2**16
LONGEST_NAME = 500
"""Letters of a member's name, with its folders."""

ENCRYPTED = 1
END, LOCAL = struct.Struct("<4s4H2LH"), struct.Struct("<4s5H3L2H")
NUMBER_CODES = {"f2": "e", "f4": "f", "f8": "d"} | {
    f"{kind}{size}": code if kind == "i" else code.upper()
    for kind in "iu"
    for size, code in zip("1248", "bhiq", strict=True)
}
"""NumPy's names of numbers, as `struct` calls them."""

ZIP64_FROM = 2**31 - 1
"""Offsets beyond this need the larger records of zip64; in a smaller file they only hide what it holds."""


class ZipArchive:
    """The arrays of an NPZ, by name without `.npy`; `file` must be seekable and stay open.

    Raises `BrokenContainer("malformed-npz")`, `UnsupportedMedia` for a zip of other things, or `LimitExceeded`.
    """

    most_members = MOST_MEMBERS
    longest_directory = LONGEST_DIRECTORY

    def __init__(self, file: BinaryIO, limits: Limits) -> None:
        self._file = file
        self._size = file.seek(0, 2)
        self._check_end()
        with broken_zip_as_malformed():
            self._zip = zipfile.ZipFile(file)
        self.members = self._checked(limits)

    def header(self, name: str) -> NpyHeader:
        """What the header of one array says, which must agree with the size of its member."""
        info = self.members[name]
        with broken_zip_as_malformed(), self.inflate(name) as file:
            header = read_npy_header(file, name)
        if header.bytes + header.data_bytes != info.file_size:
            raise malformed_zip(
                f"has {info.file_size:,} bytes for {name!r}, where its shape {header.shape} needs another number"
            )
        return header

    def number(self, name: str) -> float:
        """The first number of an array; NaN of an empty one."""
        header = self.header(name)
        code = NUMBER_CODES[header.dtype[-2:]]
        order = ">" if header.dtype.startswith(">") else "<"
        with self.inflate(name) as file:
            data = file.read(header.bytes + header.data_bytes)[header.bytes :]
        return float(struct.unpack_from(order + code, data)[0]) if data else math.nan

    @contextmanager
    def inflate(self, name: str) -> Iterator[BinaryIO]:
        """The bytes of one member, as a file; its checksum is verified at the end."""
        with broken_zip_as_malformed(), self._zip.open(self.members[name]) as file:
            yield file  # type: ignore[misc]  # IO[bytes] is what BinaryIO names

    def is_stored(self, name: str) -> bool:
        """Whether a member is there as it is, so that it can be mapped."""
        return self.members[name].compress_type == zipfile.ZIP_STORED

    def place(self, name: str) -> tuple[int, int]:
        """The bytes [start, stop) of a stored member within the file."""
        info = self.members[name]
        with broken_zip_as_malformed():
            self._file.seek(info.header_offset)  # which may be before the beginning
            record = self._file.read(LOCAL.size)
        if len(record) < LOCAL.size:
            raise malformed_zip("is cut off")
        *_, name_length, extra_length = LOCAL.unpack(record)
        start = info.header_offset + LOCAL.size + name_length + extra_length
        if start + info.file_size > self._size:
            raise malformed_zip("is cut off")
        return start, start + info.file_size

    def _check_end(self) -> None:
        """Refuse a directory that is too long before the zip reader takes it into memory."""
        tail_size = min(self._size, END.size + 2**16)
        self._file.seek(self._size - tail_size)
        tail = self._file.read(tail_size)
        at = tail.rfind(b"PK\5\6")
        if at < 0 or len(tail) - at < END.size:
            raise malformed_zip("has no directory at its end: it is cut off")
        _, _, _, _, members, length, _, _ = END.unpack_from(tail, at)
        if members > self.most_members or length > self.longest_directory:
            raise malformed_zip(f"has {members} members; {self.most_members} are read at most")
        if tail[max(at - 20, 0) : at].startswith(b"PK\6\7") and self._size <= ZIP64_FROM:
            raise malformed_zip("has a directory for a larger file than it is")

    def _checked(self, limits: Limits) -> dict[str, zipfile.ZipInfo]:
        members: dict[str, zipfile.ZipInfo] = {}
        for info in self._zip.infolist():
            name = info.filename.removesuffix(".npy")
            check_member(info)
            if name.startswith("__MACOSX/"):
                continue  # what a Mac adds of its own
            if name in members or "/" in name or "\\" in name or ".." in name:
                raise malformed_zip(f"has a member {info.filename[:80]!r}, a path or there twice")
            members[name] = info
        if not any(info.filename.endswith(".npy") for info in members.values()):
            raise UnsupportedMedia(
                "unsupported-media-type", "The file is a zip without NumPy arrays. Send a .glb, .gltf or .npz."
            )
        inflated = sum(info.file_size for info in members.values() if info.compress_type == zipfile.ZIP_DEFLATED)
        limits.check("max_inflated_bytes", inflated, "Save with numpy.savez instead of savez_compressed")
        return members


def check_member(info: zipfile.ZipInfo) -> None:
    """Raise `malformed-npz` for a member that is not read, whatever it is called."""
    if len(info.filename) > LONGEST_NAME:
        raise malformed_zip(f"has a member whose name is longer than {LONGEST_NAME} letters: {info.filename[:40]!r} …")
    if info.flag_bits & ENCRYPTED:
        raise malformed_zip("is encrypted")
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise malformed_zip("is compressed in another way than deflate")
    if info.compress_type == zipfile.ZIP_STORED and info.compress_size != info.file_size:
        raise malformed_zip(f"has two sizes for {info.filename[:80]!r}")


@contextmanager
def broken_zip_as_malformed() -> Iterator[None]:
    """Whatever the zip reader stumbles over is the file's fault."""
    try:
        yield
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        OSError,
        RuntimeError,
        ValueError,
        struct.error,
        OverflowError,
    ) as wrong:
        raise malformed_zip(f"cannot be opened ({str(wrong)[:120]})") from None


def malformed_zip(what: str) -> BrokenContainer:
    """The refusal of an archive."""
    return BrokenContainer("malformed-npz", f"The archive {what}. Save it again with numpy.savez.")
