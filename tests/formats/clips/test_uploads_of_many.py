"""Clips of what came as a BVH, in a zip, or as a mesh and its motion in two files: one GLB again."""

import numpy as np
import pytest

from caesura.core.errors import CaesuraError
from tests.formats.clips.making import clips_of, cut_at, names_of
from tests.formats.gltf.test_mesh_and_motion import mesh, skeleton
from tests.formats.opening import opened
from tests.formats.test_bvh import ARM
from tests.formats.test_zip import separate, zipped
from tests.glb import moving_square

UPLOADS = {
    "a BVH": {"arm.bvh": ARM.encode()},
    "a BVH in a zip": {"arm.zip": zipped({"takes/arm.bvh": ARM.encode()})},
    "a glTF with its buffer": separate(),
    "a glTF with its buffer in a zip": {"square.zip": zipped(separate())},
    "a GLB in a zip": {"square.zip": zipped({"a/square.glb": moving_square().glb()})},
    "a mesh and its motion": {"mesh.glb": mesh().glb(), "motion.glb": skeleton().glb()},
}


@pytest.mark.parametrize("parts", UPLOADS.values(), ids=UPLOADS)
def test_clips_are_one_file_and_show_the_frames_of_the_upload(parts: dict[str, bytes]) -> None:
    """Every clip by its name; its frames are those that it was cut from."""
    take = opened(parts, fps=30)
    cut = max(take.frames // 2, 1)
    made = clips_of(parts, cut_at(take, [cut] if take.frames > 2 else []), form="glb")
    clip = opened(made, fps=30, take=names_of(made)[0])
    assert clip.vertex_count == take.vertex_count
    shown = min(cut, clip.frames)
    np.testing.assert_allclose(clip.vertices(0, shown), take.vertices(0, shown), atol=1e-5)


def test_clips_of_a_file_that_is_nested_too_deeply_are_refused_by_name() -> None:
    """Or made: what could be read is no fault of the program."""
    deep = b'{"extras": ' + b"[" * 900 + b"]" * 900 + b", "
    data = moving_square().gltf().replace(b"{", deep, 1)
    try:
        assert opened(clips_of(data, cut_at(opened(data), [10]))).frames
    except CaesuraError as refused:
        assert refused.code == "malformed-json"  # noqa: PT017
