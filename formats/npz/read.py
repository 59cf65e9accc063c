"""An NPZ, read: `vertices` (F, V, 3) and `triangles` (T, 3), or the poses of a body model."""

import zlib
from collections.abc import Callable
from dataclasses import replace
from typing import BinaryIO, cast

import numpy as np
from jaxtyping import Float, Int, Shaped

from caesura.core.animation import Animation, Take
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.read import read_gltf
from caesura.formats.notices import Notices
from caesura.formats.npy_header import NpyHeader
from caesura.formats.npz.array_roles import check_shapes, find_body_poses, find_members_by_use
from caesura.formats.smpl.gltf_conversion import convert_poses_to_glb
from caesura.formats.smpl.pose_members import check_pose_shapes
from caesura.formats.takes.frame_rate import ASSUMED
from caesura.formats.takes.time_range import check_frame_count, parse_time_range
from caesura.formats.vertex_sequence import VertexSequence, require_finite
from caesura.formats.zip.archive import ZipArchive, malformed_zip
from caesura.formats.zip.buffer_file import BufferFile

PIECE = 2**24


def read_npz(
    data: memoryview, parameters: Parameters, limits: Limits, scratch: Callable[[int], memoryview]
) -> Animation:
    """The animation of an NPZ. Stored arrays are used where they lie, deflated ones inflated into `scratch` once.

    Raises `BrokenContainer`, `LimitExceeded`, or `InvalidModel`: `wrong-shape`, `unsupported-dtype`,
    `index-out-of-range`, `no-motion`, `varying-topology`, `non-finite-data`.
    """
    archive = ZipArchive(cast("BinaryIO", BufferFile(data)), limits)
    if poses := find_body_poses(archive):
        return _read_poses(archive, poses, data, parameters, limits, scratch)
    notices = Notices()
    names = find_members_by_use(archive, notices)
    headers = {what: archive.header(name) for what, name in names.items()}
    check_shapes(headers, names, limits)

    def array(what: str) -> Shaped[np.ndarray, "..."]:
        return _read_array(archive, names[what], headers[what], data, scratch)

    triangles = check_triangles(array("triangles"), headers["vertices"].shape[1], notices)
    stored_rate = _frame_rate(array("frame_rate")) if "frame_rate" in names else None
    rest = array("rest").astype(np.float32) if "rest" in names else None
    if rest is not None and not require_finite(rest):
        raise InvalidModel("non-finite-data", "The rest shape holds numbers that are not finite.", pointer="/rest")
    return vertex_sequence_from_arrays(array("vertices"), triangles, rest, stored_rate, parameters, limits, notices)


def _read_poses(
    archive: ZipArchive,
    names: dict[str, str],
    data: memoryview,
    parameters: Parameters,
    limits: Limits,
    scratch: Callable[[int], memoryview],
) -> Animation:
    """The animation of a body model's skeleton, without its body."""
    headers = {what: archive.header(name) for what, name in names.items()}
    joints = check_pose_shapes(headers, limits)
    arrays = {what: _read_array(archive, names[what], headers[what], data, scratch) for what in names}
    frames = headers["poses"].shape[0]
    DecodeBudget(limits).check(frames * joints * 64)
    notices = Notices()
    stored_rate = _frame_rate(arrays["frame_rate"]) if "frame_rate" in names else None
    rate, _ = _rates(parameters, stored_rate, notices)
    limits.check("max_seconds", (frames - 1) / rate, "Cut the take", "/poses")
    poses = arrays["poses"].reshape(frames, joints, 3).astype(np.float64)
    places = arrays["trans"].astype(np.float64) if "trans" in names else np.zeros((frames, 3))
    converted = convert_poses_to_glb(poses, places, rate, notices)
    animation = read_gltf(memoryview(converted.glb), {}, parameters, limits)
    return replace(animation, notices=(*converted.notices, *animation.notices))


def vertex_sequence_from_arrays(
    stored: Shaped[np.ndarray, "F V 3"],
    triangles: Int[np.ndarray, "T 3"],
    rest: Float[np.ndarray, "V 3"] | None,
    stored_rate: float | None,
    parameters: Parameters,
    limits: Limits,
    notices: Notices,
) -> Animation:
    """The animation of vertices that are there for every frame, at `stored_rate` frames a second if that is known."""
    rate, fps = _rates(parameters, stored_rate, notices)
    duration = (len(stored) - 1) / rate
    start, end = parse_time_range(parameters, duration)
    frames = check_frame_count(limits, end - start, fps, len(triangles))
    return Animation(
        vertices=VertexSequence(stored, rate / fps, _close_to_integer(start * rate)),
        vertex_count=stored.shape[1],
        triangles=triangles,
        rest=rest,
        frames=frames,
        frame_rate=fps,
        take=Take(0, "vertices", duration, frames, fps),
        start_seconds=start,
        notices=notices.in_order(),
    )


def _close_to_integer(frame: float) -> float:
    """A stored frame's number, without the rounding of the seconds that named it."""
    return float(round(frame)) if abs(frame - round(frame)) < 1e-6 else frame


def _read_array(
    archive: ZipArchive, name: str, header: NpyHeader, data: memoryview, scratch: Callable[[int], memoryview]
) -> Shaped[np.ndarray, "..."]:
    if archive.is_stored(name):
        start, stop = archive.place(name)
        piece = data[start:stop]
        verify_checksum(piece, archive.members[name].CRC, name)
    else:
        piece = inflate_member(archive, name, scratch(archive.members[name].file_size))
    return np.ndarray(
        header.shape, np.dtype(header.dtype), piece, header.bytes, order="F" if header.fortran_order else "C"
    )


def verify_checksum(piece: memoryview, expected: int, name: str) -> None:
    """Raise where a stored member is not what its checksum says."""
    check = 0
    for start in range(0, len(piece), PIECE):
        check = zlib.crc32(piece[start : start + PIECE], check)
    if check != expected:
        raise malformed_zip(f"has a wrong checksum for {name!r}: it is damaged")


def inflate_member(archive: ZipArchive, name: str, room: memoryview) -> memoryview:
    """One member, inflated into room of exactly the size that it states."""
    with archive.inflate(name) as file:
        filled = 0
        while filled < len(room) and (count := file.readinto(room[filled : filled + PIECE])):  # type: ignore[attr-defined]
            filled += count
        if filled < len(room) or file.read(1):
            raise malformed_zip(f"has another size of {name!r} than it states")
    return room


def check_triangles(stored: Shaped[np.ndarray, "T 3"], vertices: int, notices: Notices) -> Int[np.ndarray, "T 3"]:
    """The triangles as integers. Floats are taken where they are whole numbers, and that is noted.

    Raises `InvalidModel`: `unsupported-dtype` or `index-out-of-range`.
    """
    if stored.dtype.kind == "f":
        if not (np.isfinite(stored).all() and (stored == np.floor(stored)).all()):
            raise InvalidModel("unsupported-dtype", "Triangles must be whole numbers.", pointer="/triangles")
        notices.add("float-triangles", "Triangles are stored as floats. All are whole numbers, and were taken.")
    if not ((stored >= 0) & (stored < vertices)).all():
        raise InvalidModel(
            "index-out-of-range",
            f"Triangles name vertices from {stored.min():.0f} to {stored.max():.0f}, of {vertices}.",
            pointer="/triangles",
        )
    return np.ascontiguousarray(stored, np.int64)


def _frame_rate(stored: Shaped[np.ndarray, "..."]) -> float:
    rate = float(stored.reshape(-1)[0])
    if not 0 < rate <= 1e6:
        raise InvalidModel(
            "invalid-frame-rate", f"The frame rate is {rate:g}; frames per second are expected.", pointer="/frame_rate"
        )
    return rate


def _rates(parameters: Parameters, stored: float | None, notices: Notices) -> tuple[float, float]:
    """The rate of the frames in the file, and the one that is drawn."""
    if stored is None and parameters.fps == "source":
        notices.add("frame-rate-assumed", f"The file has no frame rate; {ASSUMED:g} frames a second are assumed.")
        return ASSUMED, ASSUMED
    fps = stored or ASSUMED if parameters.fps == "source" else float(parameters.fps)
    return stored or fps, fps
