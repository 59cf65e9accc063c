"""A take without its mesh, as motion capture is exported, is cut where the same take with its mesh is."""

import json
import struct

import pytest

from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from caesura.samples.sample_figures import FIGURES, build_figure
from tests.formats.opening import opened
from tests.glb import chunks

SECONDS = 0.2
SHARED = ("fox_hard_1", "godotman_hard_0", "ybot_hard_0")


def skeleton(glb):
    """The same file without meshes and skins."""
    (length,) = struct.unpack_from("<I", glb, 12)
    root = json.loads(glb[20 : 20 + length])
    for node in root["nodes"]:
        node.pop("mesh", None)
        node.pop("skin", None)
    for name in ("meshes", "skins", "materials", "textures", "images", "samplers"):
        root.pop(name, None)
    return chunks((b"JSON", json.dumps(root).encode()), (b"BIN\0", glb[28 + length :]))


def cuts(glb):
    """Seconds at which the take is cut, and whether it has triangles."""
    animation = opened(glb)
    found = segment(animation, Parameters())
    return [part.end / animation.frame_rate for part in found.segments], len(animation.triangles) > 0


def assert_alike(glb):
    with_mesh, has_mesh = cuts(glb)
    without, still_has = cuts(skeleton(glb))
    assert (has_mesh, still_has) == (True, False)
    assert len(with_mesh) == len(without) > 1
    assert max(abs(a - b) for a, b in zip(with_mesh, without, strict=True)) <= SECONDS, (with_mesh, without)


@pytest.mark.parametrize("name", FIGURES)
def test_a_sample_without_its_mesh_is_cut_alike(name):
    """As many motions, found and not told; each cut within 0.2 s."""
    assert_alike(build_figure(name).glb)


@pytest.mark.parametrize("name", SHARED)
def test_a_captured_take_without_its_mesh_is_cut_alike(shared, name):
    """An animal, and figures with hands whose fingers are most of their joints."""
    assert_alike((shared / "data" / "takes" / f"{name}.glb").read_bytes())
