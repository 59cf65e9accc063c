"""A mesh in one file and its motion in another."""

import json

import numpy as np
import pytest

from caesura.core.errors import CaesuraError, InvalidModel
from tests.formats.opening import codes, opened
from tests.glb import Glb, bending_strip, moving_square


def named() -> Glb:
    model = bending_strip()
    for name, node in zip(("body", "lower", "upper"), model.json["nodes"], strict=True):
        node["name"] = name
    for part in ("samplers", "channels"):  # the morph target's weights are of the mesh alone
        model.json["animations"][0][part].pop()
    return model


def mesh() -> Glb:
    model = named()
    del model.json["animations"]
    return model


def skeleton() -> Glb:
    """The joints alone, in another order and with one more."""
    model = Glb(scene=0, scenes=[{"nodes": [2]}], nodes=[{"name": "upper"}, {"name": "tail"}])
    model.json["nodes"].append({"name": "lower", "children": [0, 1]})
    half = np.sqrt(0.5)
    model.animate(0, "rotation", [0, 1], [[0, 0, 0, 1], [0, 0, half, half]])
    model.animate(1, "translation", [0, 1], np.zeros((2, 3)))
    return model


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("form", ["glb", "gltf"])
def test_the_motion_of_one_moves_the_mesh_of_the_other(swapped: bool, form: str) -> None:
    """By the names of its nodes, whichever file comes first; what was not found is told."""
    files = {"mesh": getattr(mesh(), form)(), "motion": getattr(skeleton(), form)()}
    animation = opened(dict(reversed(files.items())) if swapped else files, fps=30)
    expected = opened(named().glb(), fps=30)
    assert animation.frames == expected.frames == 31
    np.testing.assert_array_equal(animation.vertices(0, 31), expected.vertices(0, 31))
    assert "skeleton-paired" in codes(animation)
    assert "1 of its nodes" in animation.notices[0].detail
    assert "1 were not" in animation.notices[0].detail
    assert animation.gltf is not None


def test_a_bvh_moves_a_mesh() -> None:
    """Its joints are nodes like any others."""
    text = """HIERARCHY ROOT lower { OFFSET 0 0 0 CHANNELS 1 Xrotation JOINT upper { OFFSET 0 1 0 CHANNELS 1 Zrotation
    } }\nMOTION\nFrames: 2\nFrame Time: 0.0333333\n0 0\n0 90\n"""
    animation = opened({"mesh.glb": mesh().glb(), "motion.bvh": text.encode()})
    expected = opened(named().glb(), fps=30).vertices(30, 31)
    np.testing.assert_allclose(animation.vertices(1, 2), expected, atol=1e-6)


def test_two_files_that_are_no_pair_are_refused() -> None:
    """Both whole, or without a name in common."""
    with pytest.raises(InvalidModel) as refused:
        opened({"a": moving_square().glb(), "b": moving_square().glb()})
    assert refused.value.code == "ambiguous-upload"
    stranger = skeleton()
    for node in stranger.json["nodes"]:
        node["name"] += " of another"
    with pytest.raises(InvalidModel) as refused:
        opened({"a": mesh().glb(), "b": stranger.glb()})
    assert refused.value.code == "unmatched-skeleton"


@pytest.mark.parametrize(
    "change",
    [
        {"accessors": [1]}, {"extensionsRequired": [{}]}, {"bufferViews": None},
        {"animations": [{"samplers": [{"input": -1}], "channels": []}]},
        {"animations": [{"channels": [{"target": {"node": 99}, "sampler": 0}]}]}, {"nodes": 3}, {"buffers": [[]]},
        {"animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"target": 4}]}]},
    ],
)  # fmt: skip
def test_broken_motion_is_refused(change: dict[str, object]) -> None:
    """By an error of ours, also before the two become one."""
    broken = json.loads(skeleton().gltf()) | change
    with pytest.raises(InvalidModel):
        opened({"a": mesh().glb(), "b": json.dumps(broken).encode()})


def test_motion_nested_too_deeply_is_refused() -> None:
    """As deep as the reader of JSON lets through, too."""
    for depth in (200, 500, 900):
        nested = '{"a":' * depth + "1" + "}" * depth
        deep = skeleton().gltf()[:-1] + f', "extras": {nested}, "skins": []}}'.encode()
        try:
            opened({"a": mesh().glb(), "b": deep})
        except CaesuraError as refused:
            assert refused.code == "malformed-json"  # noqa: PT017
