"""Vertex sequences as NPZ: what is accepted, in any of NumPy's orders and kinds."""

import io
from typing import Any

import numpy as np
import pytest

from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import read_animation
from tests.formats.opening import codes, opened

FRAMES = np.random.default_rng(7).normal(size=(9, 5, 3)).astype(np.float32)
TRIANGLES = np.array([[0, 1, 2], [2, 3, 4]])


def npz(*, deflate: bool = False, **arrays: Any) -> bytes:
    out = io.BytesIO()
    (np.savez_compressed if deflate else np.savez)(out, **{"vertices": FRAMES, "triangles": TRIANGLES, **arrays})
    return out.getvalue()


@pytest.mark.parametrize("deflate", [False, True])
def test_a_sequence_is_its_frames(deflate: bool) -> None:
    """Stored or deflated, block by block, with the rate and the rest shape that it names."""
    animation = opened(npz(deflate=deflate, frame_rate=25.0, rest=FRAMES[3]))
    assert (animation.frames, animation.vertex_count, animation.frame_rate) == (9, 5, 25.0)
    assert animation.take.duration_seconds == 8 / 25
    np.testing.assert_array_equal(animation.vertices(2, 7), FRAMES[2:7])
    np.testing.assert_array_equal(animation.rest, FRAMES[3])
    np.testing.assert_array_equal(animation.triangles, TRIANGLES)
    assert codes(animation) == set()


@pytest.mark.parametrize("deflate", [False, True])
def test_only_deflated_arrays_take_room(deflate: bool) -> None:
    """Stored ones are used where they lie, so a mapped file of any size takes no memory."""
    asked: list[int] = []

    def scratch(size: int) -> memoryview:
        asked.append(size)
        return memoryview(bytearray(size))

    read_animation({"x": npz(deflate=deflate)}, Parameters(), Limits(), scratch)
    assert (max(asked, default=0) >= FRAMES.nbytes) == deflate
    assert bool(asked) == deflate


def test_other_spellings_are_understood_and_other_arrays_left_out() -> None:
    """`verts`, `faces` and `fps`; what is not used is said."""
    out = io.BytesIO()
    np.savez(out, verts=FRAMES, faces=TRIANGLES, fps=np.array([50]), colours=np.zeros(3))
    animation = opened(out.getvalue())
    assert animation.frame_rate == 50
    assert codes(animation) == {"members-ignored"}


def test_a_rate_that_nobody_names_is_30_and_said() -> None:
    """The parameter says it where the file does not."""
    assert codes(opened(npz())) == {"frame-rate-assumed"}
    assert opened(npz()).frame_rate == 30
    assert opened(npz(), fps=60).frames == 9
    assert codes(opened(npz(), fps=60)) == set()


def test_another_rate_than_the_files_draws_between_its_frames() -> None:
    """At twice the rate every second frame is the mean of its neighbours; the length in seconds stays."""
    animation = opened(npz(frame_rate=25), fps=50)
    assert (animation.frames, animation.frame_rate) == (17, 50)
    found = animation.vertices(0, 17)
    np.testing.assert_allclose(found[::2], FRAMES, atol=1e-6)
    np.testing.assert_allclose(found[1::2], (FRAMES[1:] + FRAMES[:-1]) / 2, atol=1e-6)


@pytest.mark.parametrize("dtype", ["<f4", ">f4", "<f8", ">f8", "<f2", ">f2", "<i4", "u1"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_any_number_in_any_order_is_accepted(dtype: str, order: Any) -> None:
    """Vertices come out as float32, row by row."""
    stored = np.asarray(np.abs(FRAMES) * 10, dtype, order=order)
    block = opened(npz(vertices=stored)).vertices(0, 9)
    assert block.dtype == np.float32
    assert block.flags.c_contiguous
    np.testing.assert_array_equal(block, stored.astype(np.float32))


@pytest.mark.parametrize("dtype", ["u1", "<i2", ">i4", "<u4", "<i8", "<u8", "<f4", ">f8"])
def test_triangles_may_be_any_whole_numbers(dtype: str) -> None:
    """Floats too, where they are whole; that is said."""
    animation = opened(npz(triangles=TRIANGLES.astype(dtype), frame_rate=30))
    np.testing.assert_array_equal(animation.triangles, TRIANGLES)
    assert codes(animation) == ({"float-triangles"} if "f" in dtype else set())
