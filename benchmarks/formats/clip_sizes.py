"""How large files come back in clips: each model cut in four, on its own frames and between its keys.

    python -m benchmarks.formats.clip_sizes ../shared/data

prints a line for each: bytes of the source (with its buffers), the share that the file with clips has of them, and the
share that it would have if nothing were new but what glTF asks for: a channel, a sampler and accessors for whatever
moves in each clip. A source that says things twice may come back smaller than that.
"""

import json
import struct
import sys
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import Segment, SegmentationDocument, Source, motion_name
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.write_clips import write_clips
from caesura.formats.read import read_animation

CUTS = (0.21, 0.48, 0.77)
"""Shares of a take at which it is cut; of the takes whose truth is known, that is where they are cut."""

BETWEEN = 29.0
"""Frames a second that no model has, so that cuts fall between keys."""

HEADERS = 28
"""Bytes of a GLB that are neither JSON nor data."""

Parts = Mapping[str, bytes]
Json = dict[str, Any]


def main() -> None:
    """Measure every animated model under the folders, or the files, given."""
    print(f"{'file':38} {'bytes':>9} {'on keys':>8} {'between':>8} {'asked':>8}")
    for path in sorted(found(map(Path, sys.argv[1:]))):
        parts = parts_of(path)
        size = sum(map(len, parts.values()))
        try:
            files = [clips_of(parts, fps, path.with_suffix(".truth.json")) for fps in ("source", BETWEEN)]
        except CaesuraError as refused:
            print(f"{path.name:38} {size:9} {refused.code}")
            continue
        on_keys, between = (len(file) / size for file in files)
        asked = asked_bytes(parts, path.name, files[0]) / size
        print(f"{path.name:38} {size:9} {on_keys:8.3f} {between:8.3f} {asked:8.3f}")


def found(places: Iterable[Path]) -> Iterator[Path]:
    """GLB and glTF files."""
    for place in places:
        files = place.rglob("*.gl*") if place.is_dir() else [place]
        yield from (file for file in files if file.suffix in {".glb", ".gltf"})


def parts_of(path: Path) -> dict[str, bytes]:
    """A file, and the buffers that it names."""
    parts = {path.name: path.read_bytes()}
    if path.suffix == ".gltf":
        names = {buffer.get("uri", "") for buffer in json.loads(parts[path.name])["buffers"]}
        parts |= {name: file.read_bytes() for name in names if (file := path.parent / name[:200]).is_file()}
    return parts


def clips_of(parts: Parts, fps: float | str, truth: Path) -> bytes:
    """The file with its longest take in clips."""
    parameters = Parameters.parse({"fps": fps})
    take = read_animation(parts, parameters, Limits(), scratch)
    cuts = list(cuts_of(take.frames, take.frame_rate, truth))
    rate, bounds = take.frame_rate, [0, *cuts, take.frames]
    document = SegmentationDocument(
        id="x3t6kq2v5hn7ma4zr2wye6jd4p", algorithm="1", method="switching", motions=2, frames=take.frames,
        frame_rate=rate, parameters=parameters.model_copy(update={"take": take.take.index}).model_dump(),
        duration_seconds=(take.frames - 1) / rate, key_frames=(), energy=(None,) * take.frames,
        source=Source(take=take.take.index, name=take.take.name, fps=rate, start_seconds=take.start_seconds),
        segments=tuple(
            Segment(start=a, end=b, start_seconds=a / rate, end_seconds=b / rate, motion=i % 2, name=motion_name(i % 2))
            for i, (a, b) in enumerate(pairwise(bounds))
        ),
    )  # fmt: skip
    return b"".join(write_clips(parts, document, ClipOptions(), scratch).pieces)


def cuts_of(frames: int, rate: float, truth: Path) -> Iterable[int]:
    """Where the truth cuts the take, else at `CUTS`; each a frame apart at least."""
    if not truth.is_file():
        return sorted({min(max(round(share * frames), 1), frames - 1) for share in CUTS if frames > 1})
    known = json.loads(truth.read_text(encoding="utf-8"))
    return [int(segment["start"] * rate / known["fps"]) for segment in known["segments"][1:]]


def asked_bytes(parts: Parts, name: str, file: bytes) -> int:
    """Bytes of the source as one GLB, with what clips cannot do without in place of the take that they are made of."""
    before, after = json_of(parts[name]), json_of(file)
    clips = [animation for animation in after["animations"] if "caesura" in animation.get("extras", {})]
    staying = [described(animation) for animation in after["animations"] if animation not in clips]
    takes = [animation for animation in before["animations"] if described(animation) not in staying]
    buffers = [{key: value for key, value in buffer.items() if key != "uri"} for buffer in before["buffers"]]
    stand_ins = [buffer for buffer in buffers if "extensions" in buffer]
    binary: int = sum(buffer["byteLength"] for buffer in buffers if buffer not in stand_ins)
    whole = HEADERS + length(before | {"buffers": buffers}) + binary
    return whole + required_bytes(after, clips) - required_bytes(before, takes)


def required_bytes(root: Json, animations: Iterable[Json]) -> int:
    """Bytes of JSON of animations, without extras, and of the accessors that they name."""
    animations = list(animations)
    samplers = [sampler for animation in animations for sampler in animation["samplers"]]
    named = {sampler[part] for sampler in samplers for part in ("input", "output")}
    return sum(length(described(a)) + 1 for a in animations) + sum(length(root["accessors"][n]) + 1 for n in named)


def described(animation: Json) -> Json:
    """An animation without its extras."""
    return {key: value for key, value in animation.items() if key != "extras"}


def length(value: Json) -> int:
    """Bytes of a value in JSON."""
    return len(json.dumps(value, separators=(",", ":"), ensure_ascii=False).encode(errors="surrogatepass"))


def json_of(file: bytes) -> Json:
    """The JSON of a GLB or of a glTF."""
    if file.startswith(b"glTF"):
        file = file[20 : 20 + struct.unpack_from("<I", file, 12)[0]]
    root: Json = json.loads(file)
    return root


def scratch(size: int) -> memoryview:
    """Room to draw in."""
    return memoryview(bytearray(size))


if __name__ == "__main__":
    main()
