"""The input formats by name: to add one, write its reader and add its line here. Light: no NumPy.

What detects, opens and describes files reads this table, and with it the API, OpenAPI and the command's help.
"""

import codecs
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

JSON_STARTS = (b"{", b"[", codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, b"\0{", b"\0[")
"""How JSON begins; in UTF-16 too, which glTF does not allow: opened, and refused as malformed."""


@dataclass(frozen=True)
class InputFormat:
    """One kind of file: how it is told by its first bytes, and the places of its functions below `formats`."""

    name: str
    title: str
    begins: Callable[[bytes], bool]
    header: str
    """Of a seekable file, the format's name, the file's name and limits: its `Header`. Light too."""
    to_gltf: str = ""
    """Of its bytes and limits: the same as GLB; none for glTF itself."""
    reader: str = ""
    """Of a format that is no glTF: of its bytes, parameters, limits and scratch, its `Animation`."""

    @property
    def suffix(self) -> str:
        """How names of such files end."""
        return f".{self.name}"

    def load(self, place: str) -> Callable[..., Any]:
        """One of its functions, imported at its first use."""
        module, _, name = place.partition(":")
        loaded: Callable[..., Any] = getattr(import_module(f"caesura.formats.{module}"), name)
        return loaded


def _text(head: bytes) -> bytes:
    return head.removeprefix(codecs.BOM_UTF8).lstrip(b" \t\r\n")


def _begins_with_file(head: bytes) -> bool:
    """Whether the first member of a zip is something else than an array."""
    name = head[30 : 30 + int.from_bytes(head[26:28], "little")]
    return head.startswith(b"PK\3\4") and bool(name) and not name.endswith(b".npy")


INPUT_FORMATS = {
    known.name: known
    for known in (
        InputFormat("glb", "GLB", lambda head: head.startswith(b"glTF"), "file_header:gltf_header"),
        InputFormat(
            "gltf",
            "glTF 2.0",
            lambda head: head.startswith(JSON_STARTS) or _text(head).startswith((b"{", b"[")),
            "file_header:gltf_header",
        ),
        InputFormat(
            "bvh",
            "BVH",
            lambda head: _text(head).startswith(b"HIERARCHY"),
            "file_header:bvh_header",
            to_gltf="bvh.gltf_conversion:convert_bvh_to_glb",
        ),
        InputFormat("zip", "zip", _begins_with_file, "file_header:zip_header", reader="read:read_zip"),
        InputFormat(
            "npz",
            "NumPy archive",
            lambda head: head.startswith(b"PK"),
            "file_header:npz_header",
            reader="npz.read:read_npz",
        ),
    )
}
"""The first whose beginning fits is the one."""

MODEL_SUFFIXES = tuple(known.suffix for known in INPUT_FORMATS.values() if not known.reader)
"""Of files that may lie in a zip, or come as a mesh and its motion."""

READABLE_FORMATS = ", ".join(f"{known.title} ({known.suffix})" for known in INPUT_FORMATS.values())
