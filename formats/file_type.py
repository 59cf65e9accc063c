"""What kind of file it is, by its first bytes: names and content types lie. Light: no NumPy."""

import codecs
from typing import Literal

from caesura.core.errors import UnsupportedMedia

Format = Literal["glb", "gltf", "npz", "bvh", "zip"]

SIGNATURE_BYTES = 256
"""Bytes that are enough to tell."""

READABLE_FORMATS = "glTF 2.0 (.glb, .gltf), BVH (.bvh), NumPy archives (.npz) and zips of them"

KNOWN_UNREADABLE = {
    b"version https://git-lfs": "a Git LFS pointer, not the file it stands for; fetch it with git lfs pull",
    b"\x89PNG": "a PNG image",
    b"\xff\xd8\xff": "a JPEG image",
    b"Kaydara FBX": "an FBX file; convert it to GLB, for instance with Blender",
    b"PXR-USDC": "a USD file; convert it to GLB, for instance with Blender",
    b"BLENDER": "a Blender file; export it as GLB",
    b"Ogawa": "an Alembic file; export it as GLB",
    b"\x93NUMPY": "a single NumPy array; save vertices and triangles together with numpy.savez",
    b"\x1f\x8b": "a gzip file; unpack it",
    b"ply": "a PLY file, a shape and not an animation",
    b"%PDF": "a PDF document",
}

WIDE = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, b"{\0", b"\0{", b"[\0", b"\0[")
"""How JSON begins in UTF-16, which glTF does not allow: opened, and refused as malformed."""


def detect_file_type(head: bytes) -> Format:
    """The format of a file that begins with `head`; raises `UnsupportedMedia` naming what it is instead."""
    if head.startswith(b"glTF"):
        return "glb"
    if head.startswith(b"PK"):
        return "zip" if _begins_with_a_file(head) else "npz"
    text = head.removeprefix(codecs.BOM_UTF8).lstrip(b" \t\r\n")
    if text.startswith((b"{", b"[")) or head.startswith(WIDE):
        return "gltf"
    if text.startswith(b"HIERARCHY"):
        return "bvh"
    raise UnsupportedMedia(
        "unsupported-media-type", f"The file is {_described(head, text)}. Caesura reads {READABLE_FORMATS}."
    )


def _begins_with_a_file(head: bytes) -> bool:
    """Whether the first member of a zip is something else than an array."""
    name = head[30 : 30 + int.from_bytes(head[26:28], "little")]
    return head.startswith(b"PK\3\4") and bool(name) and not name.endswith(b".npy")


def _described(head: bytes, text: bytes) -> str:
    if not head:
        return "empty"
    if text[:1] == b"<":
        return "HTML or XML, perhaps a page with an error message instead of the file"
    return next(
        (what for magic, what in KNOWN_UNREADABLE.items() if head.startswith(magic)), "of a kind that is not known"
    )
