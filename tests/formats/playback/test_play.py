"""What the page is given to play is the take, and nothing but the take."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from caesura.core.animation import Animation, Take
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.formats.playback.playback_files import make_playback
from caesura.formats.playback.strain_blocks import choose_display_patches, write_strain_blocks
from caesura.formats.playback.vertex_blocks import LARGEST, choose_display_mesh, write_vertex_blocks
from caesura.formats.read import read_animation
from caesura.samples.sample_figures import build_figure

MODELS = [
    "CesiumMan.glb", "Fox.glb", "Horse.glb", "RiggedSimple.glb", "variants/Fox_quantized.glb",
    "variants/Fox_sparse.glb",
]  # fmt: skip


def scratch(size: int) -> memoryview:
    """Memory will do."""
    return memoryview(bytearray(size))


def unpacked(data: bytes) -> tuple[dict, bytes]:
    """A block file's header and blocks."""
    length = int.from_bytes(data[8:12], "little")
    header = json.loads(data[12 : 12 + length])
    return header, data[header["blocks"]["offset"] :]


def stretched(frames: int, ratio: float = 0.5) -> Animation:
    """A square that grows along x, evenly, to 1 + ratio times its width, and is carried 20 to the side."""
    n = 9
    x, z = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    rest = np.stack([x, np.zeros_like(x), z], axis=-1).reshape(-1, 3).astype(np.float32)
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel()
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])

    def vertices(start: int, stop: int) -> np.ndarray:
        share = np.arange(start, stop, dtype=np.float32)[:, None] / (frames - 1)
        block = np.repeat(rest[None], stop - start, axis=0)
        block[..., 0] *= 1 + ratio * share
        block[..., 0] += 20 * share
        return block

    return Animation(vertices, len(rest), triangles, rest, frames, 30.0, Take(0, "", frames / 30, frames, 30.0))


def test_positions_come_back_within_half_a_step() -> None:
    """q stands for centre + half · q / 32767, on every axis and in every frame."""
    animation = stretched(70)
    mesh = choose_display_mesh(animation)
    header, blocks = unpacked(b"".join(write_vertex_blocks(animation, mesh, np.zeros(animation.vertex_count, int))))
    quantized = np.frombuffer(blocks, "<i2").reshape(70, len(mesh.vertices), 3)
    places = np.array(header["centre"]) + header["half"] * quantized / LARGEST
    assert np.abs(places - animation.vertices(0, 70)[:, mesh.vertices]).max() <= header["half"] / LARGEST * 0.51
    assert quantized.max() == LARGEST


@pytest.mark.parametrize("threads", [1, 3])
def test_strain_is_a_byte_of_what_counts_as_one(threads: int) -> None:
    """An even stretch by σ is ln σ on every patch; over the scale it stays at 255; threads change nothing."""
    animation = stretched(70)
    shown = choose_display_patches(animation.rest, animation.triangles, animation.frames, "log")
    scale = float(np.log(1.4))
    header, blocks = unpacked(b"".join(write_strain_blocks(animation, shown, scale, threads=threads)))
    found = np.frombuffer(blocks, "u1").reshape(70, header["patches"])
    expected = np.minimum(np.log(1 + 0.5 * np.arange(70) / 69) / scale, 1) * 255
    assert np.abs(found - expected[:, None]).max() <= 0.51 + 1e-3
    assert shown.of_vertex.max() < header["patches"]


def test_patches_grow_fewer_with_the_length() -> None:
    """The strain of a take of any sensible length stays below 64 MB."""
    animation = stretched(2)
    few = choose_display_patches(animation.rest, animation.triangles, 1_000_000, "log")
    many = choose_display_patches(animation.rest, animation.triangles, 1000, "log")
    assert few.means.patches <= 67 < many.means.patches


def plain(data: bytes) -> tuple[Animation, bytes, bytes]:
    """The animation of a file, its plain copy, and its strain."""
    parts = {"model": data}
    animation = read_animation(parts, Parameters(), Limits(), scratch)
    shown = make_playback(animation, analyse(animation))
    return animation, b"".join(shown.model), b"".join(shown.strain or [])


def same_motion(animation: Animation, copy: bytes) -> Iterator[float]:
    """How far the copy is from the file at some frames, as a share of the body's size."""
    again = read_animation({"copy": copy}, Parameters(fps=animation.frame_rate), Limits(), scratch)
    assert again.frames == animation.frames
    assert np.array_equal(again.triangles, animation.triangles)
    size = np.ptp(animation.vertices(0, 1)[0], axis=0).max()
    for frame in range(0, animation.frames, max(1, animation.frames // 20)):
        yield np.abs(animation.vertices(frame, frame + 1) - again.vertices(frame, frame + 1)).max() / size


@pytest.mark.parametrize("name", MODELS)
def test_a_plain_copy_moves_as_the_file_does(name: str, shared: Path) -> None:
    """Read again, the copy has the same triangles, and vertices within a millionth of the body."""
    animation, copy, _ = plain((shared / "data" / "gltf" / name).read_bytes())
    assert max(same_motion(animation, copy)) < 1e-6


@pytest.mark.parametrize("name", ["smooth", "rigid"])
def test_a_plain_copy_of_our_own_figures_moves_as_they_do(name: str) -> None:
    """The same where no other model is at hand."""
    animation, copy, _ = plain(build_figure(name).glb)
    assert max(same_motion(animation, copy)) < 1e-6


def test_a_plain_copy_holds_nothing_that_is_not_played() -> None:
    """One animation, no image, no name; every vertex knows its patch."""
    _, copy, strain = plain(build_figure("smooth").glb)
    document = json.loads(copy[20 : 20 + int.from_bytes(copy[12:16], "little")])
    assert len(document["animations"]) == 1
    assert not document.keys() & {"images", "textures", "samplers", "cameras", "extensionsRequired"}
    assert not any("name" in node for node in document["nodes"])
    assert all("_PATCH" in p["attributes"] for mesh in document["meshes"] for p in mesh["primitives"])
    assert unpacked(strain)[0]["patches"] > 0


def without_meshes(data: bytes) -> bytes:
    """The same GLB with nothing but its skeleton and its animations."""
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20 : 20 + length])
    for name in ("meshes", "skins"):
        document.pop(name, None)
    for node in document["nodes"]:
        node.pop("mesh", None)
        node.pop("skin", None)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    head = b"glTF" + (2).to_bytes(4, "little") + (20 + len(text) + len(rest)).to_bytes(4, "little")
    return head + len(text).to_bytes(4, "little") + b"JSON" + text + rest


def test_a_skeleton_without_a_mesh_is_shown_by_its_joints() -> None:
    """The joints that are taken are marked, for the page to draw bones between; nothing is strained."""
    data = without_meshes(build_figure("smooth").glb)
    parts = {"model": data}
    animation = read_animation(parts, Parameters(), Limits(), scratch)
    shown = make_playback(animation, analyse(animation))
    assert shown.document["skeleton"]
    assert shown.strain is None
    copy = b"".join(shown.model)
    document = json.loads(copy[20 : 20 + int.from_bytes(copy[12:16], "little")])
    assert sum("extras" in node for node in document["nodes"]) == animation.vertex_count
