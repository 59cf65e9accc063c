"""The rate of a clip, told from its keys."""

import numpy as np
import pytest

from caesura.formats.takes.frame_rate import KNOWN, count_frames, estimate_key_rate


@pytest.mark.parametrize("rate", KNOWN)
@pytest.mark.parametrize(("start", "frames"), [(0, 40), (1, 200), (0, 72_000)])
def test_a_key_on_every_frame_tells_the_rate(rate: float, start: int, frames: int) -> None:
    """Also where the first key is not at 0, and in long sessions, where float32 is coarse."""
    times = (np.arange(start, start + frames) / rate).astype(np.float32)
    assert estimate_key_rate(times.tolist()) == rate


def test_keys_rounded_to_milliseconds_tell_the_rate() -> None:
    """As some exporters write them."""
    assert estimate_key_rate(np.round(np.arange(50) / 30, 3).tolist()) == 30


def test_sparse_keys_tell_the_rate_whose_frames_they_are_on() -> None:
    """Keys that were thinned out are on whole frames still."""
    assert estimate_key_rate([frame / 24 for frame in (0, 5, 7, 18, 31, 32, 50)]) == 24
    assert estimate_key_rate([frame / 25 for frame in (0, 3, 4, 9, 31)]) == 25


@pytest.mark.parametrize("times", [[], [0.0], [0.0, 0.0], [0.0, 0.5, 1.0, 2.5], [0.0, 0.123, 0.777, 1.3]])
def test_keys_that_are_on_frames_of_many_rates_or_none_tell_nothing(times: list[float]) -> None:
    """Then 30 is assumed, and said."""
    assert estimate_key_rate(times) is None


def test_the_last_frame_is_not_lost_to_float32() -> None:
    """3.33333325 s at 30 frames a second are 101 frames, and endless ones are no integer but a number to compare."""
    assert count_frames(3.33333325, 30) == 101
    assert count_frames(0, 30) == 1
    assert count_frames(1e300, 1e6) > 1e300


@pytest.mark.parametrize("rate", KNOWN)
def test_no_take_of_hours_loses_its_last_frame(rate: float) -> None:
    """The last key of a long take, in float32, is up to milliseconds off its frame; the next frame is not reached."""
    for frames in (1, 63, 6_400, 72_000, 100_003, 432_001, 1_000_000):
        last = float(np.float32((frames - 1) / rate))
        assert count_frames(last, rate) == frames
