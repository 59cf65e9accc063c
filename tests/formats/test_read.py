"""The one door for files: one upload, of one or several parts."""

import mmap
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from caesura.core.errors import InvalidModel, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import list_takes, read_animation
from tests.formats.opening import opened
from tests.formats.test_npz import FRAMES, npz
from tests.glb import bending_strip, moving_square


def test_files_may_be_mapped(tmp_path: Path) -> None:
    """What a worker gives is a mapped file: nothing of it is copied to be opened."""
    for data in (moving_square().glb(), npz()):
        path = tmp_path / "upload"
        path.write_bytes(data)
        with path.open("rb") as file:
            mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        animation = read_animation({"upload": mapped}, Parameters(), Limits(), lambda size: memoryview(bytearray(size)))
        np.testing.assert_array_equal(animation.vertices(0, 5), opened(data).vertices(0, 5))


def test_the_takes_of_an_upload_are_told_before_it_is_read() -> None:
    """Of a glTF its animations, of a sequence the sequence."""
    (take,) = list_takes({"x": moving_square().glb()}, Limits())
    assert (take.index, take.name, take.frames, take.frame_rate) == (0, "take 0", 31, 30.0)
    (take,) = list_takes({"x": npz(frame_rate=25)}, Limits())
    assert (take.frames, take.frame_rate) == (len(FRAMES), 25)


def test_of_several_parts_one_must_be_the_animation() -> None:
    """Others are what it refers to; a buffer may begin like anything."""
    parts = {"a.npz": npz(), "b.bin": b"{", "c.txt": b"hello"}
    assert opened(parts).frames == len(FRAMES)
    for several in ({"a.glb": moving_square().glb(), "b.glb": moving_square().glb()}, {"a.txt": b"a", "b.txt": b"b"}):
        with pytest.raises(InvalidModel) as refused:
            opened(several)
        assert refused.value.code == "ambiguous-upload"


def test_a_lone_part_is_judged_by_its_bytes() -> None:
    """Whatever it is called."""
    assert opened({"notes.bin": moving_square().glb()}).frames == 31
    with pytest.raises(UnsupportedMedia):
        opened({"model.glb": b"<html>"})


@pytest.mark.parametrize("data", [bending_strip().glb(), npz(deflate=True)])
def test_blocks_drawn_by_several_threads_are_the_same(data: bytes) -> None:
    """Drawing shares nothing that changes."""
    animation = opened(data, fps=240)
    blocks = [(start, min(start + 3, animation.frames)) for start in range(0, animation.frames, 3)]
    with ThreadPoolExecutor(4) as pool:
        drawn = list(pool.map(lambda block: animation.vertices(*block), blocks * 4))
    whole = animation.vertices(0, animation.frames)
    for (start, stop), block in zip(blocks * 4, drawn, strict=True):
        np.testing.assert_array_equal(block, whole[start:stop])
