"""`from caesura import segment`: what a Python program has at hand goes in as it is."""

import gzip
import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import caesura
from caesura import Animation, Segmentation, open_animation, segment
from caesura.core import errors
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.parameters import Parameters
from caesura.samples.sample_figures import build_figure
from tests.animations import performing_bar
from tests.formats.point_caches import MESH, folding_sheet, pc2
from tests.installation import take_npz


@pytest.fixture(scope="module")
def bar():
    """Two motions in four segments, 720 frames."""
    return performing_bar((0, 1, 0, 1), rings=16)


@pytest.fixture(scope="module")
def vertices(bar):
    return np.array(bar.animation.vertices(0, bar.animation.frames))


def program(text):
    """What a fresh interpreter prints."""
    return subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True).stdout.strip()


def test_the_package_alone_loads_nothing():
    """`import caesura` is light, and so are the names that the web process needs; `segment` brings the numerics."""
    heavy = "print('numpy' in sys.modules)"
    assert (
        program(f"import sys, caesura, caesura.core.parameters, caesura.core.segmentation_document; {heavy}") == "False"
    )
    assert program(f"import sys, caesura; caesura.Parameters; {heavy}") == "False"
    assert program(f"import sys; from caesura import segment; {heavy}") == "True"


def test_every_public_name_is_there_and_no_other():
    """All that is listed can be had, and what cannot be had is told with what can."""
    for name in caesura.__all__:
        assert getattr(caesura, name).__name__ == name
    assert set(caesura.__all__) <= set(dir(caesura))
    with pytest.raises(AttributeError, match="'segments'; it has segment"):
        caesura.segments  # noqa: B018  asking is the test


def test_arrays_files_and_animations_give_the_same(bar, vertices):
    """Vertices, lists, an Animation and the bytes of a file of the same take are cut alike."""
    found = segment(vertices, bar.animation.triangles, rest_shape=bar.animation.rest, motions=2)
    assert isinstance(found, Segmentation)
    assert found.motions == 2
    assert (found.labels == bar.truth).mean() > 0.95
    animation = open_animation(vertices, bar.animation.triangles.tolist(), rest_shape=bar.animation.rest)
    assert isinstance(animation, Animation)
    assert np.array_equal(segment(animation, motions=2, threads=2).labels, found.labels)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A take as a file."""
    place = tmp_path_factory.mktemp("takes") / "take.npz"
    place.write_bytes(take_npz())
    return place


@pytest.mark.parametrize(
    "of",
    [
        Path.read_bytes,
        lambda path: bytearray(path.read_bytes()),
        lambda path: memoryview(path.read_bytes()),
        lambda path: {"take.npz": path.read_bytes()},
        lambda path: {"take.npz": path},
        str,
        Path,
        lambda path: [path],
        lambda path: path.open("rb"),
        lambda path: io.BytesIO(path.read_bytes()),
        lambda path: gzip.GzipFile(fileobj=io.BytesIO(gzip.compress(path.read_bytes()))),
        lambda path: after(path, b"read before"),
    ],
    ids=[
        "bytes",
        "bytearray",
        "memoryview",
        "bytes by name",
        "path by name",
        "str",
        "Path",
        "list",
        "file",
        "buffer",
        "gzip",
        "half read",
    ],
)
def test_a_file_is_its_path_its_bytes_or_itself(path, of):
    """The same result, whatever the program has at hand; an open file is read from where it stands."""
    source = of(path)
    found = segment(source, motions=2, fps=15)
    assert found.frame_rate == 15
    assert found == segment(path.read_bytes(), motions=2, fps=15)
    if hasattr(source, "close"):
        assert not source.closed
        source.close()


def after(path, read):
    """A plain file that holds something else first, which was read already."""
    place = path.with_name("after")
    place.write_bytes(read + path.read_bytes())
    file = place.open("rb")
    file.seek(len(read))
    return file


def test_a_file_that_is_none_is_said(path, tmp_path):
    """A path that leads nowhere is an OSError; a file opened as text is refused with what to do."""
    with pytest.raises(FileNotFoundError):
        segment(tmp_path / "nowhere.glb")
    for text in (io.StringIO("text"), io.TextIOWrapper(io.BytesIO(b"text"))):
        with pytest.raises(errors.UnsupportedMedia, match='mode "rb"'):
            segment(text)
    (tmp_path / "empty.glb").write_bytes(b"")
    with (tmp_path / "empty.glb").open("rb") as empty, pytest.raises(errors.UnsupportedMedia):
        segment(empty)


def test_files_that_belong_together_are_a_list(tmp_path):
    """A point cache and the mesh that it moves, by their paths; a file keeps its name in a refusal."""
    (tmp_path / "take.pc2").write_bytes(pc2(folding_sheet()))
    (tmp_path / "take.obj").write_bytes(MESH)
    found = open_animation([tmp_path / "take.pc2", str(tmp_path / "take.obj")])
    assert found.frames == len(folding_sheet())
    with pytest.raises(errors.InputError) as refused:
        open_animation(tmp_path / "take.pc2")
    assert refused.value.where.get("file", "take.pc2") == "take.pc2"


def test_a_figure_is_cut_from_its_file():
    """The sample robot, as a GLB, told nothing."""
    robot = build_figure("rigid")
    found = segment(robot.glb, threads=2)
    assert found.motions == len({label for label, _, _ in robot.truth.segments})


def test_joints_need_no_triangles(vertices):
    """Without triangles the vertices are joints, segmented on their distances."""
    assert segment(vertices[:, ::16], motions=2).motions == 2


def test_features_are_cut_as_they_are(bar, vertices):
    """A sequence of numbers for each frame has motions too, but no energy curve."""
    features = vertices[:, ::8].reshape(len(vertices), -1)
    found = segment(features, motions=2)
    assert (found.labels == bar.truth).mean() > 0.95
    assert np.isnan(found.energy).all()
    assert np.array_equal(segment(1e6 * features.astype(np.float64), motions=2).labels, found.labels)
    assert segment(np.zeros((90, 3))).motions == 1


@pytest.mark.parametrize(
    ("source", "given", "code"),
    [
        (np.zeros(9), {}, "wrong-shape"),
        (np.zeros((9, 4, 2)), {}, "wrong-shape"),
        (np.zeros((9, 4, 3), complex), {}, "wrong-shape"),
        (np.zeros((9, 4, 3)), {"triangles": [[0, 1, 4]]}, "index-out-of-range"),
        (np.zeros((9, 4, 3)), {"triangles": [[0, 1, -1]]}, "index-out-of-range"),
        (np.zeros((9, 4, 3)), {"triangles": [[0.5, 1, 2]]}, "unsupported-dtype"),
        (np.zeros((9, 4, 3)), {"triangles": [[True, False, True]]}, "wrong-shape"),
        (np.zeros((9, 4, 3)), {"rest_shape": np.zeros((3, 3))}, "wrong-shape"),
        (np.zeros((1, 4, 3)), {}, "no-motion"),
        (np.zeros((1, 4)), {}, "no-motion"),
        (np.array([[0.0], [np.nan]]), {}, "non-finite-data"),
        (b"<html>", {}, "unsupported-media-type"),
    ],
)
def test_what_cannot_be_cut_is_named(source, given, code):
    """The same errors as of files, with the same codes."""
    with pytest.raises(errors.InputError) as refused:
        segment(source, **given)
    assert refused.value.code == code


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"motion": 2}, "unknown-parameter"),
        ({"motions": 0}, "invalid-parameter"),
        ({"method": "aca"}, "motions-needed"),
        ({"frame_rate": 0.0}, "invalid-frame-rate"),
        ({"frame_rate": float("nan")}, "invalid-frame-rate"),
        ({"method": "joint-entropy"}, "invalid-parameter"),
    ],
)
def test_what_cannot_be_chosen_is_named(given, code):
    """A parameter is refused by name, before anything is computed."""
    with pytest.raises(ParameterError) as refused:
        segment(np.zeros((9, 4)), **given)
    assert refused.value.code == code


def test_what_is_read_is_not_read_again(bar):
    """`fps` cannot change an Animation that is made already; silence would be a lie in the result's parameters."""
    with pytest.raises(ParameterError, match="read already"):
        segment(bar.animation, fps=15)


def test_vertices_that_are_not_finite_are_named(vertices, bar):
    """With the frame and the vertex."""
    broken = vertices.copy()
    broken[7, 3] = np.inf
    with pytest.raises(InvalidModel, match="frame 7, vertex 3"):
        segment(broken, bar.animation.triangles)


def test_choices_are_those_of_the_api(vertices, bar):
    """What was chosen stands in the result, the rest filled in."""
    found = segment(vertices[:200], bar.animation.triangles, motions=2, window_seconds=1, end=3.0)
    assert found.parameters == Parameters(motions=2, window_seconds=1, end=3.0).model_dump()
    assert len(found.labels) == 91
