"""Which frames are taken: a part of a take, or all takes one after the other."""

import io
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import LimitExceeded, ParameterError
from caesura.core.limits import Limits
from tests.formats.opening import codes, opened
from tests.glb import Glb, moving_square, square


def late() -> bytes:
    """A square that moves from 0.5 s to 2 s by (3, 0, 0), with a key on each of 30 frames a second."""
    model = square()
    times = np.arange(15, 61) / 30
    model.animate(0, "translation", times, np.stack([2 * (times - 0.5), 0 * times, 0 * times], axis=1))
    return model.glb()


def sequence() -> bytes:
    """Eleven frames at 10 a second; frame i is at x = i."""
    file = io.BytesIO()
    places = np.arange(11)[:, None, None] + np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    np.savez(file, vertices=places.astype(np.float32), triangles=[[0, 1, 2]], frame_rate=10.0)
    return file.getvalue()


@pytest.mark.parametrize(
    ("parameters", "start", "frames"),
    [
        ({}, 0, 61),
        ({"trim": True}, 0.5, 46),
        ({"start": 1}, 1, 31),
        ({"end": 1}, 0, 31),
        ({"start": 0.25, "end": 0.75}, 0.25, 16),
        ({"start": 0.25, "end": 99, "trim": True}, 0.5, 46),
        ({"start": 2}, 2, 1),
    ],
)
def test_frame_0_is_at_the_start_that_was_asked_for(parameters: dict[str, Any], start: float, frames: int) -> None:
    """On the file's own clock, and no frame is later than the end."""
    animation = opened(late(), **parameters)
    assert (animation.start_seconds, animation.frames) == (start, frames)
    assert animation.seconds(frames - 1) <= min(float(parameters.get("end", 2)), 2) + 1e-6
    seconds = start + np.arange(frames) / 30
    drawn = animation.vertices(0, frames)[:, 0, 0]
    np.testing.assert_allclose(drawn, np.clip(2 * (seconds - 0.5), 0, 3), atol=1e-5)


@pytest.mark.parametrize(
    ("parameters", "first", "frames"),
    [({}, 0, 11), ({"start": 0.3}, 3, 8), ({"start": 0.25, "end": 0.65}, 2.5, 5), ({"trim": True, "end": 0.4}, 0, 5)],
)
def test_a_part_of_a_vertex_sequence(parameters: dict[str, Any], first: float, frames: int) -> None:
    """Stored frames where the start is on one, and between two of them where it is not."""
    animation = opened(sequence(), **parameters)
    assert (animation.start_seconds, animation.frames) == (float(parameters.get("start", 0)), frames)
    np.testing.assert_allclose(animation.vertices(0, frames)[:, 0, 0], first + np.arange(frames), atol=1e-6)


@pytest.mark.parametrize("data", [late(), sequence()])
@pytest.mark.parametrize(("parameters", "named"), [({"start": 9}, "start"), ({"start": 0.5, "end": 0.2}, "end")])
def test_nothing_left_is_refused(data: bytes, parameters: dict[str, Any], named: str) -> None:
    """With the parameter to change, and how long the take is."""
    with pytest.raises(ParameterError, match=r"s long") as refused:
        opened(data, **parameters)
    assert (refused.value.code, refused.value.where["parameter"]) == ("outside-take", named)


def test_a_limit_counts_what_is_taken_and_says_how_to_take_less() -> None:
    """A long take can be looked at in parts."""
    with pytest.raises(LimitExceeded, match="start and end"):
        opened(late(), Limits(max_seconds=1))
    assert opened(late(), Limits(max_seconds=1), end=1).frames == 31


def three_takes() -> Glb:
    """The square moves along x for a second, then stands at y = 5 for a frame, then moves along z for half a second."""
    model = moving_square()
    model.json["animations"][0]["name"] = "x"
    for name, times, values in (
        ("y", [0], [[0, 5, 0]]),
        ("z", np.arange(16) / 30, np.stack([np.zeros(16), np.zeros(16), np.arange(16)], axis=1)),
    ):
        sampler = {"input": model.accessor(times), "output": model.accessor(values)}
        channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
        model.json["animations"].append({"name": name, "samplers": [sampler], "channels": [channel]})
    model.json["animations"].append({"name": "nothing", "samplers": [], "channels": []})
    return model


def test_all_takes_follow_each_other() -> None:
    """In the order of the file, each from its own start, and the notice says where each begins."""
    data = three_takes().glb()
    animation = opened(data, take="all")
    expected = np.concatenate([opened(data, take=take).vertices(0, n) for take, n in ((0, 31), (1, 1), (2, 16))])
    assert (animation.frames, animation.take.name, animation.take.index) == (48, "all", -1)
    np.testing.assert_array_equal(animation.vertices(0, 48), expected)
    np.testing.assert_array_equal(animation.vertices(30, 33), expected[30:33])
    assert codes(animation) == {"takes-joined"}
    assert "'x' at 0, 'y' at 31, 'z' at 32" in animation.notices[0].detail
    assert animation.gltf is None


def test_a_part_of_all_takes() -> None:
    """Start and end are on the clock of all of them."""
    data = three_takes().glb()
    whole = opened(data, take="all").vertices(0, 48)
    part = opened(data, take="all", start=1.01, end=1.2)
    assert (part.frames, part.start_seconds) == (6, pytest.approx(31 / 30))
    np.testing.assert_array_equal(part.vertices(0, 6), whole[31:37])
    with pytest.raises(ParameterError) as refused:
        opened(data, take="all", start=9)
    assert refused.value.code == "outside-take"


def test_all_of_one_take_is_that_take() -> None:
    """And a take that is called so is meant by its name."""
    assert opened(moving_square().glb(), take="all").take.index == 0
    model = three_takes()
    model.json["animations"][2]["name"] = "all"
    assert opened(model.glb(), take="all").take.index == 2


def test_the_limits_count_all_takes_together() -> None:
    """Many short takes are one long film."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_FRAMES"):
        opened(three_takes().glb(), Limits(max_frames=40), take="all")
