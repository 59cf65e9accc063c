"""Files of other programs: the same take in several formats, dumps of the programs that wrote them, and broken ones."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from caesura.api import open_animation
from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.formats.read import list_takes
from tests.formats.opening import opened
from tests.formats.test_shared_formats import assert_same, cuts_of

DUMPS = {
    "blender440_shape_weight_anim_7400_binary.fbx": "blender440_shape_weight_anim_{5,15,25}",
    "blender_279_sausage_7400_binary.fbx": "blender_279_sausage_{base_0,spin_15,wiggle_20}",
    "max2009_blob_5800_ascii.fbx": "max2009_blob_{8,18}",
    "max2009_cube_anim_6100_binary.fbx": "max2009_cube_anim_{15,45}",
    "max7_skin_5000_binary.fbx": "max7_skin_{5,15}",
    "maya_axes_anim_7700_ascii.fbx": "maya_axes_anim_{0}",
    "maya_blend_inbetween_7500_binary.fbx": "maya_blend_inbetween_{1,30,60,65,71,80,89,120}",
    "maya_game_sausage_6100_ascii_wiggle.fbx": "maya_game_sausage_{wiggle_10,wiggle_18}",
    "maya_game_sausage_7500_binary_combined.fbx":
        "maya_game_sausage_{wiggle_10,wiggle_18,spin_7,spin_15,deform_8,deform_15}",
}  # fmt: skip
"""Of each file all dumps of its frames that the library itself matches, but for those that need a cache beside it."""

SCALES = {"blender440_shape_weight_anim": 1.0, "blender_279_sausage": 1.0, "max2009_cube_anim": 0.0254}
"""Metres of a unit where a dump is not in centimetres."""
Z_UP = {"max2009_cube_anim"}


def read(path: Path, request: pytest.FixtureRequest) -> bytes:
    """The bytes of a file; its test is left out where its reader is not installed."""
    needed = {".abc": "alembic", ".usdc": "usd", ".usda": "usd", ".usdz": "usd"}
    if path.suffix in needed:
        request.getfixturevalue(needed[path.suffix])
    return path.read_bytes()


def farthest(found: np.ndarray, expected: np.ndarray) -> float:
    """The largest distance of a point to the nearest of the others, relative to the diagonal."""
    away = max(cKDTree(found).query(expected)[0].max(), cKDTree(expected).query(found)[0].max())
    return float(away / np.linalg.norm(np.ptp(expected, axis=0)))


@pytest.mark.parametrize("name", ["fox_hard_0.fbx", "fox_hard_0_yup_cm.usdc", "godotman_hard_0_skel.usdc"])
def test_the_same_take_has_the_same_vertices(shared: Path, name: str, request: pytest.FixtureRequest) -> None:
    """In metres with Y up, whatever the file's units and axes."""
    take = open_animation(read(shared / "data/formats/made" / name, request))
    glb = open_animation((shared / f"data/takes/{name.partition('_hard')[0]}_hard_0.glb").read_bytes())
    for frame in (0, take.frames // 2):
        vertices, expected = take.vertices(frame, frame + 1)[0], glb.vertices(frame, frame + 1)[0]
        assert farthest(vertices, expected) < 1e-5


@pytest.mark.parametrize("name", ["fox_hard_0.fbx", "godotman_hard_0.abc", "fox_hard_0_points.usdc"])
def test_the_same_take_is_cut_alike(shared: Path, name: str, request: pytest.FixtureRequest) -> None:
    """As a skin, and as vertices of a lighter mesh."""
    data = read(shared / "data/formats/made" / name, request)
    take = open_animation(data)
    glb = (shared / f"data/takes/{name.partition('_hard')[0]}_hard_0.glb").read_bytes()
    assert_same(cuts_of(data), cuts_of(glb, end=(take.frames - 1) / take.frame_rate))


def dumped_points(path: Path, stem: str) -> np.ndarray:
    """The points of a dump, in metres with Y up."""
    lines = (line.split() for line in path.read_text().splitlines())
    points = np.array([words[1:4] for words in lines if words[:1] == ["v"]], float) * SCALES.get(stem, 0.01)
    return points[:, [0, 2, 1]] * [1, 1, -1] if stem in Z_UP else points


@pytest.mark.parametrize("name", DUMPS)
def test_points_are_those_of_the_program_that_wrote_the_file(shared: Path, name: str) -> None:
    """Skins, shapes, layers and parts, in each frame that it dumped; programs count frames from 0 or from 1."""
    folder = shared / "data/formats/ufbx"
    data, (stem, dumps) = (folder / name).read_bytes(), DUMPS[name].rstrip("}").split("_{")
    names = {take.name.rpartition("|")[2].lower(): take.index for take in list_takes({name: data}, Limits())}
    for dump in dumps.split(","):
        called, _, number = dump.rpartition("_")
        take = open_animation(data, take=names[called] if called else 0)
        points = dumped_points(folder / f"{stem}_{dump}.obj", stem)
        frames = {min(int(number), take.frames - 1), max(int(number) - 1, 0)}
        assert min(farthest(take.vertices(frame, frame + 1)[0], points) for frame in frames) < 1e-4, dump


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("real/fbx/cube_skinRig.fbx", "no-animation"),
        ("ufbx/max_cache_box_7500_binary.fbx", "external-resource"),
        ("ufbx/maya_cache_sine_7500_binary.fbx", "external-resource"),
        ("ufbx/maya_pivots_7500_ascii.fbx", "no-animation"),
        ("ufbx/synthetic_node_depth_fail_7400_binary.fbx", "malformed-fbx"),
        ("ufbx/synthetic_unsupported_cube_fail_2000_binary.fbx", "unsupported-fbx-version"),
        ("real/abc/varTopo_bakedVelocity_0-1_30fps.abc", "varying-topology"),
        ("real/abc/camera_ztranslate_300f_24fps.abc", "no-mesh"),
        ("real/abc/prman_cube.abc", "unsupported-media-type"),
        ("bad/segv_subd.abc", "index-out-of-range"),
        ("bad/abc/AbcCoreOgawa_fuzzer_issue25695.abc", "malformed-alembic"),
        ("real/usd/Creases_SpinningPyramids.usda", "external-resource"),
        ("bad/nested_references_15.usda", "limit-exceeded"),
        ("bad/usd_refs/evil.usda", "external-resource"),
    ],
)
def test_what_cannot_be_read_is_refused_in_a_sentence(
    shared: Path, name: str, code: str, request: pytest.FixtureRequest
) -> None:
    """That says what to do."""
    data = read(shared / "data/formats" / name, request)
    with pytest.raises(CaesuraError) as refused:
        opened(data, Limits())
    assert refused.value.code == code
    assert refused.value.detail.endswith(".")
