"""Takes and sizes of a file, from its header alone: the answer to an upload. Light: no NumPy.

An estimate that costs milliseconds whatever the file's size; the count of the reader holds. A file that cannot be
opened at all is refused here already.
"""

import io
from dataclasses import dataclass
from typing import BinaryIO

from caesura.core.limits import Limits
from caesura.formats.bundle.companion_file import find_companion
from caesura.formats.bundle.zip_members import ZipMembers, errors_as_zip, nested_archive_error
from caesura.formats.bvh.hierarchy import read_bvh_header
from caesura.formats.file_type import SIGNATURE_BYTES, Format, detect_file_type
from caesura.formats.gltf.animation.glb_key_times import KeyTimeReader
from caesura.formats.gltf.container import CHUNK, HEADER, glb_length, json_chunk_length, parse_root
from caesura.formats.gltf.gltf_document import check_extensions
from caesura.formats.gltf.summary import AnimationSummary, estimate_scene_size, summarise_animations
from caesura.formats.input_formats import INPUT_FORMATS
from caesura.formats.notices import Notices
from caesura.formats.npz.array_roles import check_shapes, find_body_poses, find_members_by_use
from caesura.formats.smpl.pose_members import check_pose_shapes
from caesura.formats.takes.frame_rate import ASSUMED, count_frames, snap_frame_rate
from caesura.formats.zip.archive import ZipArchive

MOST_JSON = 4 * 2**20
"""Bytes of JSON that are parsed for a header; a glTF with more is answered with unknown counts."""

MOST_FRAMES = 2**53
"""What a header's number of frames is cut at; the reader refuses it."""


@dataclass(frozen=True)
class HeaderTake:
    """One take. Its rate is told by its keys, or where they cannot be read by their number: an estimate."""

    index: int
    name: str
    duration_seconds: float
    frames: int
    frame_rate: float


@dataclass(frozen=True)
class Header:
    """Format, takes and size of a file; None where the header does not tell."""

    format: Format
    name: str
    takes: tuple[HeaderTake, ...] = ()
    vertices: int | None = None
    triangles: int | None = None


def read_header(file: BinaryIO, name: str, limits: Limits) -> Header:
    """The header of a seekable file.

    Raises `UnsupportedMedia`, `BrokenContainer`, `LimitExceeded`, or `InvalidModel` for what is already plain.
    """
    file.seek(0)
    kind = detect_file_type(file.read(SIGNATURE_BYTES))
    known = INPUT_FORMATS[kind]
    header: Header = known.load(known.header)(file, kind, name, limits)
    return header


def gltf_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of a glTF or GLB, by its JSON where that is short."""
    size = file.seek(0, 2)
    start, length = _json_of_glb(file, size) if kind == "glb" else (0, size)
    limits.check("max_json_bytes", length, "Send it as a GLB without data in its JSON")
    if length > MOST_JSON:
        return Header(kind, name)
    file.seek(start)
    root = parse_root(file.read(length), limits)
    check_extensions(root)
    found = summarise_animations(
        root, KeyTimeReader(file, start + length, root.value) if kind == "glb" else lambda _: ()
    )
    limits.check("max_takes", len(found), pointer="/animations")
    vertices, triangles = estimate_scene_size(root)
    return Header(kind, name, tuple(_take(place, clip) for place, clip in enumerate(found)), vertices, triangles)


def _json_of_glb(file: BinaryIO, size: int) -> tuple[int, int]:
    file.seek(0)
    length = glb_length(file.read(HEADER.size), size)
    start = HEADER.size + CHUNK.size
    return start, json_chunk_length(file.read(CHUNK.size), length - start)


def _take(place: int, clip: AnimationSummary) -> HeaderTake:
    rate = clip.rate or ASSUMED
    return HeaderTake(place, clip.name, clip.seconds, int(min(count_frames(clip.seconds, rate), MOST_FRAMES)), rate)


def bvh_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of a BVH."""
    file.seek(0)
    head = read_bvh_header(file.read(2 * MOST_JSON), limits)
    rate = snap_frame_rate(head.rate) or ASSUMED
    seconds = max(head.frames - 1, 0) / head.rate
    frames = int(min(count_frames(seconds, rate), MOST_FRAMES))
    return Header(kind, name, (HeaderTake(0, "motion", seconds, frames, rate),), len(head.joints), 0)


def zip_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of its model, by its first megabytes, or the number of its shapes."""
    files = ZipMembers(file, limits)
    if files.are_arrays():
        return npz_header(file, "npz", name, limits)
    model = files.model()
    if model is None:
        frames = len(files.shapes())
        return Header(kind, name, (HeaderTake(0, "vertices", (frames - 1) / ASSUMED, frames, ASSUMED),))
    with errors_as_zip(), files.inflate(model) as inner:
        data = inner.read(2 * MOST_JSON)
    known = INPUT_FORMATS[detect_file_type(data[:SIGNATURE_BYTES])]
    if known.is_archive:
        raise nested_archive_error(model)
    if known.companion:
        find_companion(known, model, files.beside(model))
    found = read_header(_FileHead(data, files.members[model].file_size), name, limits)
    return Header(kind, name, found.takes, found.vertices, found.triangles)


class _FileHead(io.BytesIO):
    """The beginning of a file of `size` bytes: what lies behind it is as if it could not be read."""

    def __init__(self, data: bytes, size: int) -> None:
        super().__init__(data)
        self._size = size

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Move, the end being that of the whole file."""
        return super().seek(offset + self._size, io.SEEK_SET) if whence == io.SEEK_END else super().seek(offset, whence)


def npz_header(file: BinaryIO, kind: Format, name: str, limits: Limits) -> Header:
    """That of an archive of arrays, by the headers of its members."""
    archive = ZipArchive(file, limits)
    poses = find_body_poses(archive)
    members = poses or find_members_by_use(archive, Notices())
    headers = {what: archive.header(member) for what, member in members.items()}
    if poses:
        vertices, triangles = check_pose_shapes(headers, limits), 0
        frames = headers["poses"].shape[0]
    else:
        check_shapes(headers, members, limits)
        frames, vertices, _ = headers["vertices"].shape
        triangles = headers["triangles"].shape[0]
    rate = archive.number(members["frame_rate"]) if "frame_rate" in members else ASSUMED
    rate = rate if 1 / MOST_FRAMES < rate < MOST_FRAMES else ASSUMED
    take = HeaderTake(0, "motion" if poses else "vertices", (frames - 1) / rate, frames, rate)
    return Header(kind, name, (take,), vertices, triangles)
