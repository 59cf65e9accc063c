"""Zips: a glTF with its buffers, a BVH, or one OBJ or PLY for every frame."""

import io
import json
import time
import zipfile
from contextlib import suppress

import numpy as np
import pytest
import trimesh

from caesura.core.errors import BrokenContainer, CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from tests.formats.opening import codes, opened
from tests.formats.test_npz import npz
from tests.glb import moving_square


def zipped(files: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as file:
        for name, data in files.items():
            file.writestr(name, data)
    return out.getvalue()


def separate(uri: str = "data.bin") -> dict[str, bytes]:
    model = moving_square()
    complete = model.complete()
    complete["buffers"][0]["uri"] = uri
    return {"square.gltf": json.dumps(complete).encode(), "data.bin": bytes(model.binary)}


def shapes(kind: str, frames: int = 12) -> dict[str, bytes]:
    """Frame i is at x = i; the names are numbered without zeros before them."""
    plain = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [2, 1, 3]], process=False)
    found = {}
    for i in range(frames):
        moved = plain.copy()
        moved.apply_translation([i, 0, 0])
        data = moved.export(file_type=kind)
        found[f"frames/body{i}.{kind}"] = data.encode() if isinstance(data, str) else data
    return found


@pytest.mark.parametrize("method", [zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED])
@pytest.mark.parametrize("folder", ["", "export/"])
def test_a_gltf_with_its_buffer(method: int, folder: str) -> None:
    """Found by its exact name beside the model, wherever in the zip both are."""
    data = zipped({f"{folder}{name}": data for name, data in separate().items()}, method)
    animation, plain = opened(data), opened(moving_square().glb())
    np.testing.assert_array_equal(animation.vertices(0, 31), plain.vertices(0, 31))
    assert animation.gltf is not None
    header = read_header(io.BytesIO(data), "x.zip", Limits())
    assert (header.format, header.vertices, len(header.takes)) == ("zip", 4, 1)


@pytest.mark.parametrize("kind", ["obj", "ply"])
def test_numbered_shapes_are_frames(kind: str) -> None:
    """In the order of their numbers, at the rate that was asked for; else 30, and that is said."""
    data = zipped(shapes(kind))
    animation = opened(data, fps=10)
    assert (animation.frames, animation.frame_rate, animation.vertex_count) == (12, 10, 4)
    np.testing.assert_allclose(animation.vertices(0, 12)[:, 0, 0], np.arange(12), atol=1e-6)
    assert codes(animation) == set()
    assert codes(opened(data)) == {"frame-rate-assumed"}
    assert read_header(io.BytesIO(data), "x.zip", Limits()).takes[0].frames == 12


@pytest.mark.parametrize("beside", ["README.txt", "__MACOSX/._vertices.npy", "about.json"])
def test_arrays_behind_another_file_are_an_archive(beside: str) -> None:
    """Zipped by hand, a note may come first; what the file is, its directory says."""
    with zipfile.ZipFile(io.BytesIO(npz())) as file:
        arrays = {name: file.read(name) for name in file.namelist()}
    data = zipped({beside: b"{}", **arrays})
    animation, plain = opened(data), opened(npz())
    np.testing.assert_array_equal(animation.vertices(0, plain.frames), plain.vertices(0, plain.frames))
    header = read_header(io.BytesIO(data), "x.npz", Limits())
    assert (header.format, header.vertices) == ("npz", plain.vertex_count)


def test_frames_of_another_mesh_are_refused_by_name() -> None:
    """The first frame that differs, in number or in order."""
    files = shapes("obj")
    files["frames/body7.obj"] = files["frames/body7.obj"].replace(b"f 1 2 3", b"f 3 2 1")
    with pytest.raises(InvalidModel, match=r"body7\.obj") as refused:
        opened(zipped(files))
    assert (refused.value.code, refused.value.where["frame"]) == ("varying-topology", 7)


HOSTILE = {
    "a path out of it": ({"../square.gltf": b"{}"}, "malformed-zip"),
    "an absolute path": ({"/etc/x.gltf": b"{}"}, "malformed-zip"),
    "a zip in it": ({"a.glb": zipped({"a.glb": b"glTF"})}, "unsupported-media-type"),
    "an archive of arrays in it": ({"a.glb": npz()}, "unsupported-media-type"),
    "nothing to read": ({"notes.txt": b"hello"}, "unsupported-media-type"),
    "two models": ({"a.gltf": b"{}", "b.glb": b""}, "ambiguous-upload"),
    "an empty model": ({"a.gltf": b""}, "unsupported-media-type"),
    "a buffer of another folder": ({"m/a.gltf": separate()["square.gltf"], "data.bin": b""}, "external-resource"),
    "a buffer that was not sent": ({"a.gltf": separate()["square.gltf"]}, "external-resource"),
    "a buffer outside": ({"a.gltf": separate("../data.bin")["square.gltf"]}, "external-resource"),
    "one shape": (dict([*shapes("obj").items()][:1]), "no-motion"),
    "shapes of two kinds": (shapes("obj") | shapes("ply"), "varying-topology"),
    "garbage as a shape": (dict.fromkeys(("a1.ply", "a2.ply"), b"garbage"), "malformed-shape"),
    "shapes of a plane": (
        {name: data.replace(b"property float z\n", b"") for name, data in shapes("ply").items()},
        None,
    ),
    "no faces": (dict.fromkeys(("a1.obj", "a2.obj"), b"v 0 0 0\n"), "no-mesh"),
    "a vertex that is not there": (dict.fromkeys(("a1.obj", "a2.obj"), b"v 0 0 0\nf 1 2 9\n"), None),
}


@pytest.mark.parametrize(("files", "code"), HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_zip_is_refused_by_name(files: dict[str, bytes], code: str | None) -> None:
    """By an error of ours, and nothing of it is written anywhere."""
    with pytest.raises(CaesuraError) as refused:
        opened(zipped(files))
    assert code is None or refused.value.code == code
    with suppress(CaesuraError):  # by its header too, or not at all
        read_header(io.BytesIO(zipped(files)), "x.zip", Limits())


def test_the_header_of_a_large_model_in_a_zip_is_read() -> None:
    """By its beginning: takes, and how large it is, whatever lies behind its JSON."""
    model = moving_square()
    model.view(bytes(9 * 2**20))
    for method in (zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED):
        header = read_header(io.BytesIO(zipped({"a.glb": model.glb()}, method)), "x.zip", Limits())
        assert (header.vertices, header.triangles, len(header.takes)) == (4, 2, 1)


@pytest.mark.parametrize("take", ["all", 1])
def test_takes_of_a_model_in_a_zip_are_chosen_as_those_of_any(take: object) -> None:
    """All of them one after the other, or one by its number."""
    model = moving_square()
    model.json["animations"] *= 2
    assert opened(zipped({"a.glb": model.glb()}), take=take).frames == (62 if take == "all" else 31)
    assert opened(zipped(shapes("obj")), take="all").frames == 12


def test_bombs_and_broken_zips_are_refused_by_their_directory() -> None:
    """Before anything is inflated; and a member whose bytes were changed is noticed."""
    bomb = zipped({"a.gltf": b" " * 2**22})
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_INFLATED_BYTES"):
        opened(bomb, Limits(max_inflated_bytes=2**20))
    good = zipped(separate(), zipfile.ZIP_STORED)
    many = zipped(dict.fromkeys(map("{}.obj".format, range(20_001)), b""))
    nameless = zipped(separate() | {"QQQ": b""}).replace(b"QQQ", b"\0QQ")  # names end at a zero
    stored = zipped(shapes("obj"), zipfile.ZIP_STORED)
    headless = stored[:60] + stored[100:]  # its directory points before its beginning
    for broken in (nameless, headless, good[:-30], good.replace(b'"version"', b'"versioN"', 1), many):
        with pytest.raises(CaesuraError) as refused:
            opened(broken)
        assert refused.value.code == "malformed-zip"


SHAPE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize("name", [f"{'1' * 60_000}a1.obj", f"{'1' * 60_000}.obj", f"{'x' * 501}1.npy"])
def test_a_name_of_many_digits_is_refused_at_once(name: str) -> None:
    """A pattern for the number of a frame was tried at each of 60,000 digits, for a minute."""
    data = zipped({name: SHAPE, "a2.obj": SHAPE})
    began = time.process_time()
    with pytest.raises(BrokenContainer, match="longer than 500 letters"):
        read_header(io.BytesIO(data), "x.zip", Limits())
    with pytest.raises(BrokenContainer, match="longer than 500 letters"):
        opened(data)
    assert time.process_time() - began < 2


def test_names_of_digits_are_read_in_linear_time() -> None:
    """The last number counts, up to 18 digits."""
    names = [f"{'1' * 480}a{i}.obj" for i in range(400)]
    began = time.process_time()
    animation = opened(zipped(dict.fromkeys(names[::-1], SHAPE)))
    assert (animation.frames, animation.vertex_count) == (400, 3)
    assert time.process_time() - began < 2
