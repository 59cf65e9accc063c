"""The input formats by name: to add one, write its reader and add its line here. Light: no NumPy.

What detects, opens and describes files reads this table, and with it the API, OpenAPI and the command's help.
"""

import codecs
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from itertools import pairwise
from typing import Any

JSON_STARTS = (b"{", b"[", codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, b"\0{", b"\0[")
"""How JSON begins; in UTF-16 too, which glTF does not allow: opened, and refused as malformed."""


LARGEST = 2**24
"""An MDD has fewer samples, points and seconds: else other files begin as one too."""


@dataclass(frozen=True)
class Companion:
    """A file that another cannot be read without: how its name ends, and what it holds."""

    suffix: str
    holds: str


FACES = Companion(".obj", "its faces")
SKELETON = Companion(".asf", "its skeleton")
AMC_KEYWORD = re.compile(rb"^:(FULLY-SPECIFIED|DEGREES|RADIANS|SAMPLES-PER-SECOND)\b", re.MULTILINE | re.IGNORECASE)


@dataclass(frozen=True)
class InputFormat:
    """One kind of file: how it is told by its first bytes, and the places of its functions below `formats`."""

    name: str
    title: str
    begins: Callable[[bytes], bool]
    header: str
    """Of a seekable file, the format's name, the file's name and limits: its `Header`. Light too."""
    description: str = ""
    """What of such files is read."""
    to_gltf: str = ""
    """Of its bytes and limits: its `GltfConversion`; none for glTF itself."""
    reader: str = ""
    """Of a format that is no glTF: of its bytes, parameters, limits and scratch, its `Animation`."""
    clips: str = ""
    """Of a `ClipRequest`, a zip of clips of the same kind; none where clips are GLB."""
    companion: Companion | None = None
    """The file that must come with it, whose bytes its functions take after its own."""
    other_suffixes: tuple[str, ...] = ()
    """How names of such files end elsewhere."""
    is_archive: bool = False
    """Whether it holds files; one in another is not opened, for there may be another one in it, without end."""

    @property
    def suffixes(self) -> tuple[str, ...]:
        """How names of such files end."""
        return (f".{self.name}", *self.other_suffixes)

    @property
    def label(self) -> str:
        """What people are told: `PC2 (.pc2 with its .obj)`."""
        beside = f" with its {self.companion.suffix}" if self.companion else ""
        return f"{self.title} ({', '.join(self.suffixes)}{beside})"

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


def _begins_as_usd(head: bytes) -> bool:
    """Whether a file is a layer in text or as a crate, or a zip that begins with a layer."""
    name = head[30 : 30 + int.from_bytes(head[26:28], "little")].lower()
    package = head.startswith(b"PK\3\4") and name.endswith((b".usd", b".usda", b".usdc"))
    return package or head.startswith(b"PXR-USDC") or _text(head).startswith(b"#usda ")


def _begins_as_mdd(head: bytes) -> bool:
    """Whether a file without a mark may be an MDD: numbers of samples and points, and seconds that increase."""
    samples, points = struct.unpack_from(">ii", head.ljust(8, b"\0"))
    seconds = struct.unpack_from(f">{min(max(samples, 0), len(head) // 4 - 2)}f", head, 8) if len(head) > 16 else ()
    fits = 1 < samples < LARGEST and 0 < points < LARGEST and len(seconds) > 1
    return fits and all(abs(a) < LARGEST and a < b for a, b in pairwise(seconds))


INPUT_FORMATS = {
    known.name: known
    for known in (
        InputFormat(
            "glb",
            "GLB",
            lambda head: head.startswith(b"glTF"),
            "upload_summary:gltf_header",
            "skins, morph targets, moving parts or a skeleton, also compressed by Draco or meshopt; VRM animations",
            other_suffixes=(".vrma",),
        ),
        InputFormat(
            "gltf",
            "glTF 2.0",
            lambda head: head.startswith(JSON_STARTS) or _text(head).startswith((b"{", b"[")),
            "upload_summary:gltf_header",
            "the same as JSON, its buffers inside or sent with it",
        ),
        InputFormat(
            "bvh",
            "BVH",
            lambda head: _text(head).startswith(b"HIERARCHY"),
            "upload_summary:bvh_header",
            "a skeleton and its motion",
            to_gltf="bvh.gltf_conversion:convert_bvh_to_glb",
            clips="clips.in_kind.bvh_clips:write_bvh_clips",
        ),
        InputFormat(
            "fbx",
            "FBX",
            lambda head: head.startswith(b"Kaydara FBX Binary  ") or _text(head).startswith(b"; FBX"),
            "native.fbx.header:fbx_header",
            "versions 5000 to 7700, text and binary: skins, blend shapes, parts or a skeleton; every stack is a take",
            to_gltf="native.fbx.gltf_conversion:convert_fbx_to_glb",
        ),
        InputFormat(
            "abc",
            "Alembic",
            lambda head: head.startswith(b"Ogawa"),
            "native.alembic.header:alembic_header",
            "Ogawa: meshes and subdivision surfaces below moving transforms, with `caesura[alembic]`",
            reader="native.alembic.read:read_alembic",
        ),
        InputFormat(
            "pc2",
            "PC2",
            lambda head: head.startswith(b"POINTCACHE2\0"),
            "point_cache.header:pc2_header",
            "the places of the points of a mesh in every frame",
            reader="point_cache.read:read_pc2",
            clips="clips.in_kind.point_cache_clips:write_pc2_clips",
            companion=FACES,
        ),
        InputFormat(
            "mdd",
            "MDD",
            _begins_as_mdd,
            "point_cache.header:mdd_header",
            "the same, with a time for every frame",
            reader="point_cache.read:read_mdd",
            clips="clips.in_kind.point_cache_clips:write_mdd_clips",
            companion=FACES,
        ),
        InputFormat(
            "c3d",
            "C3D",
            lambda head: len(head) > 24 and 1 < head[0] < 32 and head[1] == 0x50,
            "c3d.header:c3d_header",
            "optical markers; gaps of up to a second are filled",
            to_gltf="c3d.gltf_conversion:convert_c3d_to_glb",
        ),
        InputFormat(
            "usd",
            "USD",
            _begins_as_usd,
            "native.usd.header:usd_header",
            "text, crate and package: skeletons with blend shapes, or points in time, with `caesura[usd]`",
            reader="native.usd.read:read_usd",
            clips="clips.in_kind.usd_clips:write_usd_clips",
            other_suffixes=(".usda", ".usdc", ".usdz"),
        ),
        InputFormat(
            "amc",
            "AMC",
            lambda head: head.startswith(b"#!OML") or AMC_KEYWORD.search(head) is not None,
            "asf.amc_header:amc_header",
            "the motion of a skeleton",
            to_gltf="asf.gltf_conversion:convert_amc_to_glb",
            companion=SKELETON,
        ),
        InputFormat(
            "zip",
            "zip",
            _begins_with_file,
            "upload_summary:zip_header",
            "one of the others with the files beside it, or an OBJ or PLY for every frame, numbered",
            reader="read:read_zip",
            clips="clips.in_kind.numbered_mesh_clips:write_shape_clips",
            is_archive=True,
        ),
        InputFormat(
            "npz",
            "NumPy archive",
            lambda head: head.startswith(b"PK"),
            "upload_summary:npz_header",
            "vertices (F, V, 3) and triangles (T, 3), or poses of SMPL bodies as AMASS has them",
            reader="npz.read:read_npz",
            clips="clips.npz_clips:write_npz_clips",
            is_archive=True,
        ),
    )
}
"""The first whose beginning fits is the one."""

MODEL_SUFFIXES = tuple(suffix for known in INPUT_FORMATS.values() if not known.is_archive for suffix in known.suffixes)
"""Of files that may lie in a zip."""

COMPANION_SUFFIXES = tuple(
    dict.fromkeys([".bin", *(known.companion.suffix for known in INPUT_FORMATS.values() if known.companion)])
)
"""Of files that are no animation of their own: what a glTF keeps beside it, and what other formats must have there."""

READABLE_FORMATS = ", ".join(known.label for known in INPUT_FORMATS.values())
