"""USD: layers as text, as crates and in packages; skeletons as glTF, anything else that deforms as vertices."""

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from tests.formats.native.usd_text import (
    FACES,
    bending_strip,
    blending_square,
    layer,
    nested_references,
    sliding_points,
    sliding_square,
    square,
)
from tests.formats.opening import codes, opened
from tests.formats.test_zip import zipped

SLIDE = """double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 4: (4, 0, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]"""

pytestmark = pytest.mark.usefixtures("usd")


def test_a_mesh_moves_with_its_transform() -> None:
    """A frame at every time code, at the rate of the time codes; and clips are glTF."""
    take = opened(sliding_square())
    assert (take.frames, take.frame_rate, take.vertex_count, len(take.triangles)) == (5, 30, 4, 2)
    np.testing.assert_allclose(take.vertices(0, 5)[:, 0, 0], range(5), atol=1e-6)
    assert take.gltf is not None
    assert opened(sliding_square(rate=24)).frame_rate == 24


def test_any_unit_and_axis_become_metres_with_y_up() -> None:
    """In centimetres with z up: what was up is up."""
    take = opened(sliding_square(metres=0.01, up="Z"))
    np.testing.assert_allclose(take.vertices(4, 5)[0, 2], [0.05, 0, -0.01], atol=1e-7)


def test_points_that_are_stored_for_each_frame_are_vertices() -> None:
    """Without a range that is stated, from the first sample to the last."""
    take = opened(sliding_points())
    assert (take.frames, take.frame_rate, take.gltf, codes(take)) == (5, 30, None, set())
    np.testing.assert_allclose(take.vertices(0, 5)[:, 1, 0], range(1, 6), atol=1e-6)


def test_a_skin_bends_where_its_joint_bends() -> None:
    """By glTF as by the library, which blends dual quaternions too; there a notice says what becomes of clips."""
    expected = np.add([[0, 0], [1, 0], [0, 1], [0.5, 1.5], [-1, 1], [-1, 2]], (3, 0))
    strip = opened(bending_strip(place="(3, 0, 0)"))
    assert strip.take.name == "bend"
    assert strip.gltf is not None
    np.testing.assert_allclose(strip.vertices(30, 31)[0, :, :2], expected, atol=1e-6)
    blended = opened(bending_strip("dualQuaternion", "(3, 0, 0)"))
    assert blended.gltf is None
    assert codes(blended) == {"read-as-vertices"}
    np.testing.assert_allclose(blended.vertices(30, 31)[0, [0, 1, 4, 5], :2], expected[[0, 1, 4, 5]], atol=1e-6)


def test_names_of_joints_and_takes_stay() -> None:
    """What an engine gets of the clips."""
    take = opened(bending_strip())
    assert take.gltf is not None
    glb = bytes(take.gltf[""])
    root = json.loads(glb[20 : 20 + int.from_bytes(glb[12:16], "little")])
    assert [node["name"] for node in root["nodes"]] == ["figure", "strip", "skeleton", "hip", "knee"]
    assert len(root["skins"][0]["joints"]) == 2
    assert root["animations"][0]["name"] == "bend"


def test_a_shape_between_is_there_alone_at_its_weight() -> None:
    """It rises to 4 at half the time and sinks to 1, by its name and not its place among the weights."""
    heights = opened(blending_square()).vertices(0, 31)[:, 2, 2]
    np.testing.assert_allclose(heights[[0, 15, 30]], [0, 4, 1], atol=1e-5)


def test_a_take_that_begins_later_is_counted_from_its_first_frame() -> None:
    """A notice says where it begins."""
    take = opened(sliding_square(first=101))
    assert (take.frames, codes(take)) == (5, {"take-start"})


def test_shear_is_read_as_vertices() -> None:
    """glTF has no place for it, and what is read is right."""
    sheared = "( (1, 0, 0, 0), (0.5, 1, 0, 0), (0, 0, 1, 0), (%d, 0, 0, 1) )"
    values = ", ".join(f"{frame}: {sheared % frame}" for frame in range(3))
    more = f"matrix4d xformOp:transform.timeSamples = {{ {values} }}\n"
    more += '        uniform token[] xformOpOrder = ["xformOp:transform"]'
    take = opened(layer(f'def Xform "figure"\n{{\n{square(more)}}}\n'))
    assert take.gltf is None
    np.testing.assert_allclose(take.vertices(2, 3)[0, 2], [3.5, 1, 0], atol=1e-6)


def test_a_crate_is_read_as_its_text(tmp_path: Path) -> None:
    """The binary kind, written by the library."""
    from pxr import Sdf

    text = Sdf.Layer.CreateAnonymous(".usda")
    assert text.ImportFromString(bending_strip().decode())
    assert text.Export(str(tmp_path / "strip.usdc"))
    crate = opened((tmp_path / "strip.usdc").read_bytes())
    np.testing.assert_array_equal(crate.vertices(0, 31), opened(bending_strip()).vertices(0, 31))


def test_a_package_is_read_by_its_first_layer() -> None:
    """As it is; a package whose layer is compressed is none."""
    files = {"take.usda": sliding_square(), "wood.png": b"no picture"}
    assert opened(zipped(files, zipfile.ZIP_STORED)).frames == 5
    with pytest.raises(BrokenContainer, match="usdzip"):
        opened(zipped(files))


def test_no_file_outside_is_ever_opened(tmp_path: Path) -> None:
    """Sublayers, references, payloads and clips, also in variants: what is beside them is read, and they are named."""
    outside = tmp_path / "outside.usda"
    outside.write_bytes(sliding_square())
    body = f"""
def Xform "figure" (
    prepend references = @{outside}@</figure>
    prepend payload = @{outside}@</figure>
)
{{
{square(SLIDE)}
}}
def "V" (
    variants = {{
        string v = "a"
    }}
    prepend variantSets = "v"
)
{{
    variantSet "v" = {{
        "a" (
            prepend references = @{outside}@</figure>
        ) {{
        }}
    }}
}}
def "C" (
    clips = {{
        dictionary default = {{
            string templateAssetPath = "{tmp_path}/outside.#.usda"
            double templateStartTime = 0
            double templateEndTime = 1
            double templateStride = 1
            string primPath = "/figure"
        }}
    }}
)
{{
}}
"""
    data = layer(body, span=(0, 4)).replace(b'defaultPrim = "figure"', f"subLayers = [@{outside}@]".encode())
    take = opened(data)
    assert take.vertex_count == 4
    assert "references-left-out" in codes(take)
    with pytest.raises(InvalidModel, match=r"outside\.usda") as refused:
        opened(layer(f'def "figure" (prepend references = @{outside}@</figure>) {{ }}'))
    assert refused.value.code == "external-resource"


def test_references_inside_are_bounded_before_they_are_followed() -> None:
    """Sixty levels of two: counted, and never composed. A few levels are read as what they are."""
    with pytest.raises(LimitExceeded, match="MAX_NODES"):
        opened(nested_references(60))
    with pytest.raises(InvalidModel, match="no mesh"):
        opened(nested_references(3))
    with pytest.raises(LimitExceeded, match="nested too deeply"):
        opened(layer('def "a"\n{\n' * 3_000 + "}\n" * 3_000))


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ("point3f[] points.timeSamples = { 0: [(0, 0, 0)], 1: [(0, 0, 0), (1, 1, 1)] }", "index-out-of-range"),
        (
            "point3f[] points.timeSamples = { 0: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], 1: [(0, 0, 0)] }",
            "varying-topology",
        ),
        ('token visibility = "invisible"', "no-mesh"),
        ('uniform token purpose = "guide"', "no-mesh"),
    ],
)
def test_what_cannot_be_segmented_is_refused(more: str, code: str) -> None:
    """Faces of points that are not there, points that come and go, and what is never seen."""
    with pytest.raises(InvalidModel) as refused:
        opened(layer(f'def Xform "figure"\n{{\n{square(more)}}}\n'))
    assert refused.value.code == code


def test_faces_that_change_are_refused() -> None:
    """The name of the mesh is said."""
    changing = square().replace(FACES, "int[] faceVertexCounts = [4]\nint[] faceVertexIndices.timeSamples = "
                                "{ 0: [0, 1, 2, 3], 1: [3, 2, 1, 0] }\n")  # fmt: skip
    with pytest.raises(InvalidModel, match="/figure/square") as refused:
        opened(layer(f'def Xform "figure"\n{{\n{changing}}}\n'))
    assert refused.value.code == "varying-topology"


@pytest.mark.parametrize("data", [b"#usda 1.0\n(", b"PXR-USDC" + bytes(90), sliding_square()[:400]])
def test_a_broken_file_is_refused_by_its_name(data: bytes) -> None:
    """Cut off, or not what its first bytes say."""
    with pytest.raises(BrokenContainer, match=r"Export it again\.") as refused:
        opened({"walk.usd": data})
    assert (refused.value.code, refused.value.where["file"]) == ("malformed-usd", "walk.usd")


@pytest.mark.parametrize(
    ("limits", "setting"),
    [
        (Limits(max_vertices=5), "MAX_VERTICES"),
        (Limits(max_triangles=3), "MAX_TRIANGLES"),
        (Limits(max_frames=20), "MAX_FRAMES"),
        (Limits(max_seconds=0.5), "MAX_SECONDS"),
        (Limits(max_node_frames=50), "MAX_NODE_FRAMES"),
        (Limits(max_nodes=4), "MAX_NODES"),
    ],
)
def test_what_is_too_large_is_refused(limits: Limits, setting: str) -> None:
    """The setting is named."""
    with pytest.raises(LimitExceeded, match=setting):
        opened(bending_strip(), limits)
