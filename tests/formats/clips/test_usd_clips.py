"""Clips of USD: layers of their own that are read as the frames of the take, skeletons and shapes still in them."""

import importlib.util
import io
import zipfile
from pathlib import Path

import numpy as np
import pytest

from caesura.core.errors import LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.write_clips import write_clips
from tests.conftest import unavailable
from tests.formats.clips.making import clips_of, cut_at, scratch
from tests.formats.native import usd_text
from tests.formats.opening import opened

CUTS = [7, 20]


@pytest.fixture(scope="module", autouse=True)
def usd() -> None:
    if importlib.util.find_spec("pxr") is None:
        unavailable("usd-core is not installed: make extras")


def unzipped(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def check_clips(data: bytes, cuts: list[int]) -> dict[str, bytes]:
    """One after the other the clips are the take, within 1e-5 of its diagonal; answers them."""
    take = opened(data)
    whole = take.vertices(0, take.frames)
    diagonal = np.linalg.norm(np.ptp(whole.reshape(-1, 3), axis=0))
    clips = unzipped(clips_of(data, cut_at(take, cuts)))
    assert list(clips) == ["A_01.usda", "B_01.usda", "A_02.usda"]
    for clip, start, end in zip(clips.values(), [0, *cuts], [*cuts, take.frames], strict=True):
        part = opened(clip)
        assert (part.frames, part.frame_rate) == (end - start, take.frame_rate)
        assert np.abs(part.vertices(0, part.frames) - whole[start:end]).max() <= 1e-5 * diagonal
        np.testing.assert_array_equal(part.triangles, take.triangles)
    return clips


def blended() -> bytes:
    """A square whose corner is drawn out by a blend shape, and in again."""
    weights = usd_text.samples({frame: f"[{abs(np.sin(frame / 4)):.6f}]" for frame in range(31)})
    more = """uniform token[] skel:blendShapes = ["out"]
        rel skel:blendShapeTargets = </figure/square/out>
        rel skel:skeleton = </figure/skeleton>
        def BlendShape "out"
        {
            uniform vector3f[] offsets = [(1, 0, 0)]
            uniform int[] pointIndices = [2]
        }"""
    square = usd_text.square(more).replace(
        'def Mesh "square"', 'def Mesh "square" (prepend apiSchemas = ["SkelBindingAPI"])'
    )
    return usd_text.layer(
        f"""def SkelRoot "figure"
{{
    def Skeleton "skeleton" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        rel skel:animationSource = </figure/skeleton/weights>
        def SkelAnimation "weights"
        {{
            uniform token[] blendShapes = ["out"]
            float[] blendShapeWeights.timeSamples = {weights}
        }}
    }}
{square}}}
""",
        span=(0, 30),
    )


@pytest.mark.parametrize("first", [0, 101])
def test_clips_of_a_moved_mesh_are_the_take(first: int) -> None:
    clips = check_clips(usd_text.sliding_square(31, first), CUTS)
    assert b"endTimeCode = 12" in clips["B_01.usda"]
    assert b"startTimeCode = 0" in clips["B_01.usda"]


def test_clips_of_points_in_time_are_the_take() -> None:
    check_clips(usd_text.sliding_points(31), CUTS)


@pytest.mark.parametrize("method", ["classicLinear", "dualQuaternion"])
def test_clips_of_a_skeleton_keep_it_and_are_cut_between_its_keys(method: str) -> None:
    """Two keys in 30 frames: at cuts the clips have the pose that the take has between them."""
    for clip in check_clips(usd_text.bending_strip(method), CUTS).values():
        assert b'def SkelAnimation "bend"' in clip
        assert b"rotations.timeSamples" in clip


def test_clips_of_blend_shapes_keep_them() -> None:
    for clip in check_clips(blended(), CUTS).values():
        assert b"blendShapeWeights.timeSamples" in clip


def test_clips_may_stay_at_their_time_and_have_handles() -> None:
    data = usd_text.sliding_square(31, 101)
    take = opened(data)
    kept = unzipped(clips_of(data, cut_at(take, CUTS), origin="keep"))["B_01.usda"]
    assert b"startTimeCode = 108" in kept
    handled = opened(unzipped(clips_of(data, cut_at(take, CUTS), handles_seconds="0.1"))["B_01.usda"])
    np.testing.assert_allclose(handled.vertices(0, handled.frames), take.vertices(4, 23), atol=1e-5)


def test_a_crate_and_a_package_come_back_as_layers_in_text(tmp_path: Path) -> None:
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous("take.usda")
    layer.ImportFromString(usd_text.sliding_square(31).decode())
    layer.Export(str(tmp_path / "take.usdc"))
    crate = (tmp_path / "take.usdc").read_bytes()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as package:
        package.writestr("take.usdc", crate)
    for data in (crate, packed.getvalue()):
        check_clips(data, CUTS)


def test_clips_of_a_usd_as_one_glb_are_still_to_be_had() -> None:
    data = usd_text.bending_strip()
    assert clips_of(data, cut_at(opened(data), CUTS), form="glb")[:4] == b"glTF"


@pytest.mark.parametrize(
    "name", ["made/fox_hard_0_skel.usdc", "made/fox_hard_0_points.usdc", "made/cesiumman_skel.usdz",
             "made/morphstress_skel.usdc", "real/usd/CesiumMan.usdz"],
)  # fmt: skip
def test_clips_of_what_others_export_are_the_take(shared: Path, name: str) -> None:
    check_clips((shared / "data/formats" / name).read_bytes(), [15, 31])


def test_the_writer_s_process_has_the_limits_of_the_service() -> None:
    """It opens the file again, with a library of native code: the file may do no more there than when it was read."""
    data = usd_text.sliding_points()
    document = cut_at(opened(data), CUTS)
    with pytest.raises(LimitExceeded):
        b"".join(write_clips({"a.usda": data}, document, ClipOptions(), scratch, Limits(max_vertices=1)).pieces)
