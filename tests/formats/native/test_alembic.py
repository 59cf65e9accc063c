"""Alembic: meshes with vertices for every sample, below transforms that move as well."""

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, InvalidModel, LimitExceeded, UnsupportedMedia
from caesura.core.limits import Limits
from tests.formats.native.alembic_files import SQUARE, archive, moved
from tests.formats.opening import codes, opened

pytestmark = pytest.mark.usefixtures("alembic")

SLIDING = [moved(x=i) for i in range(5)]


@pytest.mark.parametrize("kind", ["PolyMesh", "SubD"])
def test_vertices_move_with_the_transforms_above_them(kind: str) -> None:
    """The mesh along x, its transform along y, and the one above that ten along z."""
    take = opened(archive(SLIDING, kind=kind, places=[(0, 2 * i, 0) for i in range(5)]))
    assert (take.frames, take.frame_rate, take.vertex_count, len(take.triangles)) == (5, 30, 4, 2)
    expected = np.array(SQUARE) + np.array([[[i, 2 * i, 10]] for i in range(5)])
    np.testing.assert_allclose(take.vertices(0, 5), expected, atol=1e-6)


def test_a_transform_may_leave_its_parents_out() -> None:
    """Then the place of the one above is not added."""
    take = opened(archive(SLIDING, inherits=False))
    np.testing.assert_allclose(take.vertices(4, 5)[0], np.add(SQUARE, (4, 0, 0)), atol=1e-6)


def test_a_rigid_mesh_moves_with_its_transform_alone() -> None:
    """One sample of vertices, and several places."""
    take = opened(archive(places=[(i, 0, 0) for i in range(3)]))
    np.testing.assert_allclose(take.vertices(0, 3)[:, 0, 0], [0, 1, 2], atol=1e-6)


def test_frames_are_at_the_times_of_the_samples() -> None:
    """At 24 a second from 2 seconds on, which a notice says; and at times that are listed one by one."""
    take = opened(archive(SLIDING, rate=24, first=2))
    assert (take.frames, take.frame_rate) == (5, 24)
    assert codes(take) == {"take-start"}
    listed = opened(archive(SLIDING, times=[0, 0.04, 0.08, 0.16, 0.2]))
    assert (listed.frames, listed.frame_rate) == (6, 25)
    np.testing.assert_allclose(listed.vertices(0, 6)[:, 0, 0], [0, 1, 2, 2.5, 3, 4], atol=1e-5)


def test_a_mesh_that_is_made_anew_is_refused() -> None:
    """By other points, or by other faces on the same points; its name and the time are said."""
    for frames, faces in (([SQUARE, [*SQUARE, (2, 2, 2)]], ()), ([SQUARE, moved(1)], [(0, 1, 2, 3), (3, 2, 1, 0)])):
        with pytest.raises(InvalidModel, match=r"'square' .* at 0\.033 s") as refused:
            opened(archive(frames, faces=faces))
        assert refused.value.code == "varying-topology"


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (archive, "no-motion"),
        (lambda: archive(SLIDING, visible=0), "no-mesh"),
        (lambda: archive([SQUARE, moved(1)], faces=[(0, 1, 2, 9)] * 2), "index-out-of-range"),
        (lambda: archive([SQUARE, [(np.nan, 0, 0)] * 4]), "non-finite-data"),
    ],
)
def test_what_cannot_be_segmented_is_refused(data: object, code: str) -> None:
    """Without motion, without a mesh that is seen, with faces or places that are none."""
    with pytest.raises(InvalidModel) as refused:
        opened(data()).vertices(0, 2)  # type: ignore[operator]
    assert refused.value.code == code


def test_a_broken_archive_is_refused() -> None:
    """Cut off; and of the older kind, which is HDF5."""
    with pytest.raises(BrokenContainer, match=r"Export it again\.") as refused:
        opened({"cloth.abc": archive(SLIDING)[:300]})
    assert (refused.value.code, refused.value.where["file"]) == ("malformed-alembic", "cloth.abc")
    with pytest.raises(UnsupportedMedia, match="Ogawa"):
        opened(b"\x89HDF\r\n\x1a\n" + bytes(100))


@pytest.mark.parametrize(
    ("limits", "setting"),
    [
        (Limits(max_vertices=3), "MAX_VERTICES"),
        (Limits(max_triangles=1), "MAX_TRIANGLES"),
        (Limits(max_frames=4), "MAX_FRAMES"),
        (Limits(max_triangle_frames=9), "MAX_TRIANGLE_FRAMES"),
        (Limits(max_inflated_bytes=100), "MAX_INFLATED_BYTES"),
        (Limits(max_nodes=3), "MAX_NODES"),
    ],
)
def test_what_is_too_large_is_refused(limits: Limits, setting: str) -> None:
    """The setting is named."""
    with pytest.raises(LimitExceeded, match=setting):
        opened(archive(SLIDING), limits)


def test_an_archive_may_lie_in_a_zip() -> None:
    """As any other file of an animation."""
    from tests.formats.test_zip import zipped

    assert opened(zipped({"export/cloth.abc": archive(SLIDING)})).frames == 5
