"""What an upload is answered with, before anything of it is decoded."""

import io
import struct
import subprocess
import sys
import time

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, InvalidModel, LimitExceeded, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.upload_summary import MOST_JSON, Header, HeaderTake, read_header
from tests.glb import square

TWO_TAKES = b"""{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}, {"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "animations": [
  {"name": "walk", "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}],
   "samplers": [{"input": 2, "output": 3}]},
  {"channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}], "samplers": [{"input": 4, "output": 3}]}],
 "accessors": [{"count": 8}, {"count": 36}, {"count": 25, "min": [0], "max": [1]}, {"count": 25},
  {"count": 2, "min": [0], "max": [2.5]}]}"""


def header(data: bytes, limits: Limits | None = None) -> Header:
    return read_header(io.BytesIO(data), "model", limits or Limits())


def glb(text: bytes) -> bytes:
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


def archive(**arrays: object) -> bytes:
    out = io.BytesIO()
    np.savez_compressed(out, **arrays)  # type: ignore[arg-type]
    return out.getvalue()


@pytest.mark.parametrize(("data", "kind"), [(TWO_TAKES, "gltf"), (glb(TWO_TAKES), "glb")])
def test_a_gltf_tells_its_takes_and_its_size(data: bytes, kind: str) -> None:
    """Every take with its rate and frames, and the vertices and triangles of all instances."""
    takes = (HeaderTake(0, "walk", 1.0, 25, 24.0), HeaderTake(1, "take 1", 2.5, 76, 30.0))
    assert header(data) == Header(kind, "model", takes, 16, 24)  # type: ignore[arg-type]


def test_an_archive_tells_its_frames_at_its_own_rate() -> None:
    """Shapes come from the arrays' headers, the rate from its one number."""
    data = archive(verts=np.zeros((11, 4, 3), ">f8"), faces=np.zeros((2, 3), np.uint8), fps=np.float16(25))
    assert header(data) == Header("npz", "model", (HeaderTake(0, "vertices", 0.4, 11, 25.0),), 4, 2)


def test_the_rate_is_told_by_the_keys_themselves_where_they_are_at_hand() -> None:
    """Thinned keys of a GLB, whose number alone would tell another rate; what is broken in them tells nothing."""
    model = square()
    frames = np.array([0, 1, 2, 3, 4, 15, 23, 24])
    model.animate(0, "scale", frames / 24, np.ones((8, 3)))
    (take,) = header(model.glb()).takes
    assert (take.frames, take.frame_rate, take.duration_seconds) == (25, 24.0, 1.0)
    for broken in (np.nan, np.inf, -1, 3e38):
        struct.pack_into("<f", model.binary, model.json["bufferViews"][2]["byteOffset"] + 28, broken)
        assert header(model.glb()).takes[0].duration_seconds in (0, pytest.approx(3e38))


def test_much_json_is_not_parsed() -> None:
    """More than 4 MB of JSON would hold the web process up: its counts are unknown, its container is checked."""
    assert header(TWO_TAKES.ljust(MOST_JSON + 1)) == Header("gltf", "model", (), None, None)


def test_odd_numbers_in_a_header_are_left_out() -> None:
    """What is no plain number counts as nothing; the reader, not the header, says what is wrong with it."""
    odd = TWO_TAKES.replace(b'"count": 8', b'"count": true').replace(b'"max": [1]', b'"max": [1e999]')
    assert header(odd).vertices == 0
    assert header(odd).takes[0].frames == 1


@pytest.mark.parametrize(
    ("data", "error", "code"),
    [
        (b"", UnsupportedMedia, "unsupported-media-type"),
        (b"<!doctype html>", UnsupportedMedia, "unsupported-media-type"),
        (b"version https://git-lfs.github.com/spec/v1\n", UnsupportedMedia, "unsupported-media-type"),
        (glb(TWO_TAKES)[:100], BrokenContainer, "malformed-glb"),
        (b"{", BrokenContainer, "malformed-json"),
        (b'{"asset": {"version": "1.0"}}', InvalidModel, "unsupported-gltf-version"),
        (b'{"asset": {"version": "2.0"}, "extensionsRequired": ["X"]}', InvalidModel, "unsupported-extension"),
        (b"PK\3\4", BrokenContainer, "malformed-npz"),
        (archive(vertices=np.zeros((2, 3, 4)), triangles=np.zeros((1, 3), int)), InvalidModel, "wrong-shape"),
    ],
)
def test_what_cannot_be_opened_is_refused_at_once(data: bytes, error: type[Exception], code: str) -> None:
    """An upload is answered with its problem where the header tells it already."""
    with pytest.raises(error) as refused:
        header(data)
    assert refused.value.code == code  # type: ignore[attr-defined]


def test_the_limit_on_json_holds_for_headers() -> None:
    """A JSON over the limit is refused, not left unknown."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_JSON_BYTES"):
        header(TWO_TAKES, Limits(max_json_bytes=10))


def test_reading_headers_loads_no_numerics() -> None:
    """The web process reads headers, and must stay small."""
    loaded = "any(module in sys.modules for module in ('numpy', 'numba', 'scipy'))"
    script = f"import sys, caesura.formats.upload_summary; sys.exit({loaded})"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_keys_beyond_the_end_of_the_file_tell_nothing() -> None:
    """A binary chunk may state more bytes than there are: what is wrong with that is the reader's to say."""
    model = square()
    model.animate(0, "scale", np.arange(4) / 24, np.ones((4, 3)))
    model.json["bufferViews"][2]["byteOffset"] = 10**6
    data = bytearray(model.glb())
    start = 20 + int.from_bytes(data[12:16], "little")
    data[start : start + 4] = (2**32 - 1).to_bytes(4, "little")
    (take,) = header(bytes(data)).takes
    assert take.duration_seconds == 0


@pytest.mark.parametrize("rate", [0.0, 5e-324, 1e-300, 1e300, -1.0, np.nan, np.inf])
def test_a_rate_that_is_none_leaves_a_take_that_can_be_told(rate: float) -> None:
    """Seconds are a finite number, as JSON needs, whatever the file says of its rate."""
    (take,) = header(archive(vertices=np.zeros((11, 4, 3)), triangles=np.zeros((2, 3), int), frame_rate=rate)).takes
    assert (take.frame_rate, take.frames) == (30.0, 11)


def test_long_names_of_many_takes_make_a_small_header() -> None:
    """A name is cut to a hundred letters, which its last letter says; a thousand takes are read."""
    model = square()
    model.animate(0, "scale", [0, 1], np.ones((2, 3)))
    model.json["animations"] = [{**model.json["animations"][0], "name": f"{i} {'x' * 3000}"} for i in range(1000)]
    takes = header(model.glb()).takes
    assert (len(takes), sum(len(take.name) for take in takes)) == (1000, 100_000)
    assert takes[7].name == f"7 {'x' * 97}…"
    model.json["animations"].append({})
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_TAKES"):
        header(model.glb())


def test_the_keys_of_many_takes_are_read_in_little_time() -> None:
    """Uneven keys of two hundred takes held the web process up for eight seconds."""
    model = square()
    times = np.sort(np.random.default_rng(0).uniform(0, 1000, 10_000))
    model.animate(0, "scale", times, np.ones((len(times), 3)))
    model.json["accessors"][model.json["animations"][0]["samplers"][0]["input"]] |= {"min": [0], "max": [1000]}
    model.json["animations"] *= 200
    began = time.process_time()
    takes = header(model.glb()).takes
    assert time.process_time() - began < 2
    assert {round(take.duration_seconds) for take in takes} == {1000}
