"""Clips of body poses: of `poses` and `trans` the rows of each segment."""

import io
from collections.abc import Iterator

import numpy as np
from jaxtyping import Shaped

from caesura.formats.clips.clip_plan import Clip
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.zip.archive import ZipArchive
from caesura.formats.zip.stream_writer import stream_zip

PIECE = 2**22


def write_pose_clips(request: ClipRequest, archive: ZipArchive, names: dict[str, str]) -> Iterator[bytes]:
    """The zip of one NPZ for each clip. Members that are not of the motion are copied, such as `betas`."""
    moving = {names[what]: _array(archive, names[what]) for what in ("poses", "trans") if what in names}
    rate = archive.number(names["frame_rate"]) if "frame_rate" in names else None
    stored = request.stored_frames(len(moving[names["poses"]]), rate)

    def members(clip: Clip) -> Iterator[tuple[str, Iterator[bytes]]]:
        start, stop = stored.of(clip)
        for name, info in archive.members.items():
            array = moving.get(name)
            yield info.filename, _copy(archive, name) if array is None else _npy(array[start:stop])

    clips = ((f"{clip.name}.npz", stream_zip(members(clip), deflated=True)) for clip in request.clips)
    return stream_zip(clips, deflated=False)


def _array(archive: ZipArchive, name: str) -> Shaped[np.ndarray, "frames ..."]:
    with archive.inflate(name) as file:
        found: Shaped[np.ndarray, "frames ..."] = np.lib.format.read_array(file, allow_pickle=False)
    return found


def _npy(array: Shaped[np.ndarray, "frames ..."]) -> Iterator[bytes]:
    out = io.BytesIO()
    np.lib.format.write_array(out, np.ascontiguousarray(array), allow_pickle=False)
    yield out.getvalue()


def _copy(archive: ZipArchive, name: str) -> Iterator[bytes]:
    with archive.inflate(name) as file:
        while piece := file.read(PIECE):
            yield piece
