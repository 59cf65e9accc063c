"""Point caches: places in one file, faces in another."""

import io
import struct
from collections.abc import Callable

import numpy as np
import pytest
from click.testing import CliRunner

from caesura.core.errors import CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.upload_summary import HeaderTake, read_header
from caesura.service.commands.cli import main
from tests.formats.opening import codes, opened
from tests.formats.point_caches import FACES, MESH, folding_sheet, mdd, obj, pc2
from tests.formats.test_zip import zipped

PLACES = folding_sheet()
TRIANGLES = [[0, 3, 2], [0, 2, 1], [3, 4, 5], [3, 5, 2]]
SECONDS = np.arange(len(PLACES)) / 24


def both(**other: bytes) -> dict[str, bytes]:
    return {"sheet.pc2": pc2(PLACES), "sheet.obj": MESH, **other}


@pytest.mark.parametrize("data", [pc2(PLACES), mdd(PLACES, SECONDS)], ids=["pc2", "mdd"])
def test_a_cache_is_its_places_and_the_faces_of_its_mesh(data: bytes) -> None:
    """Number by number, in little and in big-endian order; a square is two triangles."""
    sheet = opened({"cache": data, "sheet.obj": MESH})
    np.testing.assert_array_equal(sheet.vertices(0, len(PLACES)), PLACES.astype(np.float32))
    assert sheet.triangles.tolist() == TRIANGLES
    assert sheet.rest is None


def test_an_mdd_has_a_clock() -> None:
    """Its samples have seconds; those of 15 a second, which is nobody's usual rate, are 15 a second all the same."""
    for rate in (15.0, 23.976, 24.0, 30.0, 120.0):
        times = 7 + np.arange(len(PLACES)) / rate
        sheet = opened({"a.mdd": mdd(PLACES, times), "a.obj": MESH})
        assert sheet.frame_rate == pytest.approx(rate, rel=1e-6)
        assert codes(sheet) == set()
    uneven = SECONDS + 0.1 * (np.arange(len(PLACES)) > 20)
    assert codes(opened({"a.mdd": mdd(PLACES, uneven), "a.obj": MESH})) == {"uneven-samples"}


def test_a_pc2_counts_frames_and_no_seconds() -> None:
    """Thirty frames a second are assumed and said, also where a sample stands for two frames or for half of one."""
    sheet = opened(both())
    assert (sheet.frame_rate, codes(sheet)) == (30, {"frame-rate-assumed"})
    for step in (2.0, 0.5):
        sheet = opened({"a.pc2": pc2(PLACES, step=step), "a.obj": MESH})
        assert (sheet.frame_rate, codes(sheet)) == (30 / step, {"frame-rate-assumed"})
    assert codes(opened(both(), fps=25)) == set()


def test_the_mesh_is_the_one_that_is_called_like_the_cache() -> None:
    """In an upload of several files, and in a zip; where there is only one it may be called anything."""
    other = obj(PLACES[0], [[0, 1, 2]])
    assert opened(both(**{"other.obj": other})).triangles.tolist() == TRIANGLES
    assert opened(zipped(both(**{"other.obj": other}))).triangles.tolist() == TRIANGLES
    folder = {f"export/{name}": data for name, data in {"a.mdd": mdd(PLACES, SECONDS), "Base.OBJ": MESH}.items()}
    assert opened(zipped(folder)).triangles.tolist() == TRIANGLES
    with pytest.raises(InvalidModel, match="same name") as refused:
        opened({"a.pc2": pc2(PLACES), "b.obj": MESH, "c.obj": MESH})
    assert refused.value.code == "ambiguous-upload"


@pytest.mark.parametrize("alone", [{"a.pc2": pc2(PLACES)}, {"a.zip": zipped({"a.mdd": mdd(PLACES, SECONDS)})}])
def test_a_cache_alone_says_what_it_needs(alone: dict[str, bytes]) -> None:
    """Its faces, and how to send them; a zip says so at the upload already."""
    with pytest.raises(InvalidModel, match=r"\.obj that holds its faces") as refused:
        opened(alone)
    assert refused.value.code == "missing-companion"
    if "a.zip" in alone:
        with pytest.raises(InvalidModel, match=r"\.obj that holds its faces"):
            read_header(io.BytesIO(alone["a.zip"]), "a.zip", Limits())


def test_the_header_tells_points_and_samples() -> None:
    """And nothing of triangles, which are in the other file."""
    header = read_header(io.BytesIO(pc2(PLACES)), "a.pc2", Limits())
    assert (header.format, header.vertices, header.triangles) == ("pc2", 6, None)
    assert header.takes == (HeaderTake(0, "vertices", pytest.approx(39 / 30), 40, 30.0),)
    header = read_header(io.BytesIO(mdd(PLACES, SECONDS)), "a.mdd", Limits())
    assert (header.format, header.vertices, header.triangles) == ("mdd", 6, None)
    assert header.takes == (HeaderTake(0, "vertices", pytest.approx(39 / 24), 40, 24.0),)
    header = read_header(io.BytesIO(zipped(both())), "a.zip", Limits())
    assert (header.vertices, header.takes[0].frames) == (6, 40)


def _with(offset: int, form: str, value: float) -> Callable[[bytes], bytes]:
    def change(data: bytes) -> bytes:
        out = bytearray(data)
        struct.pack_into(form, out, offset, value)
        return bytes(out)

    return change


BROKEN = {
    "pc2 cut off": (pc2(PLACES), lambda data: data[:-1], "malformed-pc2"),
    "pc2 of a head": (pc2(PLACES), lambda data: data[:31], "malformed-pc2"),
    "pc2 of version 2": (pc2(PLACES), _with(12, "<i", 2), "malformed-pc2"),
    "pc2 without points": (pc2(PLACES), _with(16, "<i", 0), "malformed-pc2"),
    "pc2 of fewer than none": (pc2(PLACES), _with(16, "<i", -6), "malformed-pc2"),
    "pc2 of many points": (pc2(PLACES), _with(16, "<i", 2**31 - 1), "limit-exceeded"),
    "pc2 of many samples": (pc2(PLACES), _with(28, "<i", 2**31 - 1), "animation-too-long"),
    "pc2 of a step of nothing": (pc2(PLACES), _with(24, "<f", 0), "malformed-pc2"),
    "pc2 of a step that is no number": (pc2(PLACES), _with(24, "<f", float("nan")), "malformed-pc2"),
    "pc2 of one sample": (pc2(PLACES[:1]), lambda data: data, "no-motion"),
    "pc2 with a point nowhere": (pc2(PLACES), _with(32 + 12, "<f", float("inf")), "non-finite-data"),
    "pc2 of other points": (pc2(PLACES[:, :5]), lambda data: data, "unmatched-points"),
    "mdd cut off": (mdd(PLACES, SECONDS), lambda data: data[:-1], "malformed-mdd"),
    "mdd of its times": (mdd(PLACES, SECONDS), lambda data: data[:100], "malformed-mdd"),
    "mdd of more samples": (mdd(PLACES, SECONDS), _with(0, ">i", 41), "ambiguous-upload"),
    "mdd that goes back": (mdd(PLACES, SECONDS[::-1]), lambda data: data, "ambiguous-upload"),
    "mdd with a point nowhere": (mdd(PLACES, SECONDS), _with(8 + 160, ">f", float("nan")), "non-finite-data"),
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_broken_cache_is_refused(fault: str) -> None:
    """By what it says before its numbers, or by the first number that is no place."""
    data, change, code = BROKEN[fault]
    with pytest.raises(CaesuraError) as refused:
        opened({"cache": change(data), "sheet.obj": MESH}).vertices(0, len(PLACES))
    assert refused.value.code == code


@pytest.mark.parametrize(
    ("mesh", "code"),
    [
        (b"", "no-mesh"),
        (b"v 0 0 0\n" * 6, "no-mesh"),
        (obj(PLACES[0], [[0, 1, 6]]), "malformed-shape"),
        (obj(PLACES[0], [[0, 1, -1]]), "malformed-shape"),
        (b"v 0 0 x\n" * 6 + b"f 1 2 3\n", "malformed-shape"),
    ],
)
def test_a_broken_mesh_is_refused(mesh: bytes, code: str) -> None:
    """In a sentence that says which of the two files is wrong."""
    with pytest.raises(InvalidModel, match="OBJ") as refused:
        opened({"a.pc2": pc2(PLACES), "a.obj": mesh})
    assert refused.value.code == code


def test_limits_hold_for_the_mesh() -> None:
    """An OBJ of many faces is refused before they are read."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_TRIANGLES"):
        opened({"a.pc2": pc2(PLACES), "a.obj": obj(PLACES[0], FACES * 10)}, Limits(max_triangles=10))


def test_the_command_takes_both_files(tmp_path) -> None:
    """In any order; the mesh is no animation of its own."""
    for name, data in both().items():
        (tmp_path / name).write_bytes(data)
    run = CliRunner().invoke(main, ["segment", str(tmp_path / "sheet.obj"), str(tmp_path / "sheet.pc2")])
    assert run.exit_code == 0, run.output
    assert "sheet.pc2, take vertices: 40 frames" in run.output
