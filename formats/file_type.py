"""The format of a file, detected from its first bytes; names and content types can be wrong. Light: no NumPy."""

import codecs

from caesura.core.errors import UnsupportedMedia
from caesura.formats.input_formats import INPUT_FORMATS, READABLE_FORMATS

Format = str
"""A name in `INPUT_FORMATS`."""

SIGNATURE_BYTES = 256
"""Bytes that are enough to tell."""

KNOWN_UNREADABLE = {
    b"version https://git-lfs": "a Git LFS pointer, not the file it stands for; fetch it with git lfs pull",
    b"\x89PNG": "a PNG image",
    b"\xff\xd8\xff": "a JPEG image",
    b"BLENDER": "a Blender file; export it as GLB",
    b"\x89HDF": "an HDF5 file; if it is an Alembic, export it anew as Ogawa, the kind of Alembic that is written today",
    b"\x93NUMPY": "a single NumPy array; save vertices and triangles together with numpy.savez",
    b"\x1f\x8b": "a gzip file; unpack it",
    b"ply": "a PLY file, a shape and not an animation",
    b"# AST/ASF": "a skeleton without a motion; send it with its AMC",
    b":version": "a skeleton without a motion; send it with its AMC",
    b"%PDF": "a PDF document",
}


def detect_file_type(head: bytes) -> Format:
    """The format of a file that begins with `head`; raises `UnsupportedMedia` naming what it is instead."""
    for name, known in INPUT_FORMATS.items():
        if known.begins(head):
            return name
    raise UnsupportedMedia(
        "unsupported-media-type", f"The file is {_format_name(head)}. Caesura reads {READABLE_FORMATS}."
    )


def _format_name(head: bytes) -> str:
    if not head:
        return "empty"
    if head.removeprefix(codecs.BOM_UTF8).lstrip()[:1] == b"<":
        return "HTML or XML, perhaps a page with an error message instead of the file"
    return next(
        (what for magic, what in KNOWN_UNREADABLE.items() if head.startswith(magic)), "of a kind that is not known"
    )
