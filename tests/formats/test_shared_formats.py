"""One take in every format: the same cuts within a frame, and the same motions, whatever it was stored as."""

import json
from pathlib import Path

import numpy as np
import pytest

from caesura.api import open_animation, segment
from caesura.core.errors import InvalidModel
from tests.formats.clips.making import chunks_of
from tests.glb import chunks

Cuts = tuple[list[int], list[str]]


def cuts_of(source: bytes | dict[str, bytes], **parameters: float) -> Cuts:
    """The first frames of its segments, and their motions."""
    found = segment(source, **parameters).document().segments
    return [one.start for one in found], [one.name for one in found]


def without_meshes(glb: bytes) -> bytes:
    """The same skeleton alone."""
    root, binary = chunks_of(glb)
    for node in root["nodes"]:
        node.pop("mesh", None)
        node.pop("skin", None)
    del root["meshes"], root["skins"]
    return chunks((b"JSON", json.dumps(root).encode()), (b"BIN\0", binary))


def assert_same(found: Cuts, expected: Cuts) -> None:
    assert found[1] == expected[1]
    assert all(abs(a - b) <= 1 for a, b in zip(found[0], expected[0], strict=True)), (found, expected)


@pytest.mark.parametrize("name", ["fox_hard_0", "godotman_hard_0"])
def test_blender_s_bvh_is_cut_as_the_joints_that_it_was_made_of(shared: Path, name: str) -> None:
    """A position on every joint; in one of them several roots below a root without channels, which is no joint."""
    bvh = (shared / f"data/formats/made/{name}.bvh").read_bytes()
    joints = without_meshes((shared / f"data/takes/{name}.glb").read_bytes())
    take = open_animation(bvh)
    assert_same(cuts_of(bvh), cuts_of(joints, end=(take.frames - 1) / take.frame_rate))


@pytest.mark.parametrize("name", ["fox_hard_0.pc2", "godotman_hard_0.mdd"])
def test_a_point_cache_is_cut_as_the_mesh_that_it_was_made_of(shared: Path, name: str) -> None:
    """Of fewer vertices, and without a shape at rest."""
    made = shared / "data/formats/made"
    files = {path.name: path.read_bytes() for path in (made / name, made / f"{Path(name).stem}_base.obj")}
    take = open_animation(files)
    mesh = (shared / f"data/takes/{Path(name).stem}.glb").read_bytes()
    assert_same(cuts_of(files), cuts_of(mesh, end=(take.frames - 1) / take.frame_rate))


def test_a_cache_without_its_mesh_says_what_is_missing(shared: Path) -> None:
    """A file of a web page, whose mesh the page makes itself."""
    with pytest.raises(InvalidModel, match=r"with the \.obj that holds its faces"):
        open_animation((shared / "data/formats/real/mdd/cube.mdd").read_bytes())


def test_a_session_of_an_optical_laboratory_is_read(shared: Path) -> None:
    """Forty-one markers on a person of ordinary height, from frame 50 on, without a gap."""
    take = open_animation((shared / "data/formats/real/c3d/CMU_02_01.c3d").read_bytes())
    assert (take.frames, take.frame_rate, take.vertex_count) == (343, 120, 41)
    assert 1.5 < np.ptp(take.vertices(0, 1)[0, :, 1]) < 2
    assert {notice.code for notice in take.notices} == {"skeleton-only"}
