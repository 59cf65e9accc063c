"""A USD package is a zip whose first file is the layer; files lie in it as they are. Light: no NumPy."""

from typing import BinaryIO, cast

from caesura.core.errors import BrokenContainer, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.bundle.zip_members import ZipMembers, errors_as_zip
from caesura.formats.zip.buffer_file import BufferFile

LAYERS = (".usd", ".usda", ".usdc")


def first_layer(data: memoryview, limits: Limits) -> memoryview:
    """The layer of a package; any other file as it is. Raises `BrokenContainer` or `UnsupportedMedia`."""
    if bytes(data[:4]) != b"PK\3\4":
        return data
    files = ZipMembers(cast("BinaryIO", BufferFile(data)), limits)
    name = min(files.members, key=lambda member: files.members[member].header_offset, default="")
    if not name.lower().endswith(LAYERS):
        raise UnsupportedMedia("unsupported-media-type", f"The package begins with {name[:80]!r}, which is no layer.")
    if not files.is_stored(name):
        raise BrokenContainer(
            "malformed-zip", f"{name[:80]!r} is compressed, which no file of a USD package is. Make it with usdzip."
        )
    with errors_as_zip():
        start, stop = files.place(name)
    return data[start:stop]
