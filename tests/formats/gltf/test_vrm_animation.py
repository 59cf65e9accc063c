"""VRM animations: the bones of a humanoid are joints, and what stands for its face is not."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import InvalidModel
from caesura.formats.playback.playable_gltf import write_playable_gltf
from tests.formats.clips.making import chunks_of
from tests.formats.opening import codes, opened
from tests.formats.test_zip import zipped
from tests.glb import Glb

HALF = np.sqrt(0.5)


def waving(**extension: Any) -> Glb:
    """Hips and a head that turns, a smile that comes and goes, and eyes that follow something."""
    nodes = [
        {"name": "hips", "children": [1]}, {"name": "head", "translation": [0, 1, 0]}, {"name": "happy"},
        {"name": "eyes"},
    ]  # fmt: skip
    bones = {"hips": {"node": 0}, "head": {"node": 1}}
    face = {"expressions": {"preset": {"happy": {"node": 2}}, "custom": {}}, "lookAt": {"node": 3}}
    said = {"specVersion": "1.0", "humanoid": {"humanBones": bones}, **face, **extension}
    model = Glb(
        scene=0, scenes=[{"nodes": [0, 2, 3]}], nodes=nodes, extensions={"VRMC_vrm_animation": said},
        extensionsUsed=["VRMC_vrm_animation"], extensionsRequired=["VRMC_vrm_animation"],
    )  # fmt: skip
    model.animate(0, "rotation", [0, 1, 2], [[0, 0, 0, 1], [0, 0, HALF, HALF], [0, 0, 0, 1]])
    model.animate(2, "translation", [0, 1, 2], [[0, 0, 0], [1, 0, 0], [0, 0, 0]])
    model.animate(3, "rotation", [0, 1, 2], [[0, 0, 0, 1], [0, 1, 0, 0], [0, 0, 0, 1]])
    return model


def test_the_bones_of_a_humanoid_are_joints_and_its_face_is_not() -> None:
    """A smile is no place in space: its node, and that of the eyes, are left out and that is said."""
    take = opened(waving().glb(), fps=30)
    assert (take.vertex_count, take.frames) == (2, 61)
    np.testing.assert_allclose(take.vertices(30, 31)[0], [[0, 0, 0], [-1, 0, 0]], atol=1e-6)
    assert codes(take) == {"skeleton-only", "vrm-controls-ignored"}


def test_the_page_draws_the_same_joints() -> None:
    """Marked in the file that it plays."""
    parts = {"a.vrma": memoryview(waving().glb())}
    pieces, *_ = write_playable_gltf(parts, 0, np.zeros(2, np.int64))
    root, _ = chunks_of(b"".join(pieces))
    assert [node.get("extras") for node in root["nodes"]] == [{"joint": True}, {"joint": True}, None, None]


def test_a_face_alone_is_nothing_to_segment() -> None:
    """Refused as a file in which no joint moves."""
    model = waving()
    del model.json["animations"][0]["channels"][0]
    with pytest.raises(InvalidModel) as refused:
        opened(model.glb(), fps=30)
    assert refused.value.code == "no-mesh"


@pytest.mark.parametrize(
    "wrong",
    [{"lookAt": {"node": 4}}, {"lookAt": 3}, {"expressions": {"preset": {"happy": {"node": -1}}}}, {"expressions": []}],
    ids=str,
)
def test_a_face_on_a_node_that_is_not_there_is_refused(wrong: dict[str, Any]) -> None:
    """With the place in the file."""
    with pytest.raises(InvalidModel) as refused:
        opened(waving(**wrong).glb())
    assert refused.value.code == "invalid-gltf"
    assert str(refused.value.where["pointer"]).startswith("/extensions/VRMC_vrm_animation")


def test_one_lies_in_a_zip_by_its_name() -> None:
    """As any other model."""
    assert opened(zipped({"wave.vrma": waving().glb(), "readme.txt": b"hello"})).vertex_count == 2


def test_a_real_animation_of_the_format_is_read(shared: Path) -> None:
    """An arm and its fingers."""
    take = opened((shared / "data/formats/real/vrma/test.vrma").read_bytes())
    assert (take.frames, take.vertex_count) == (91, 18)
