"""The keys of an F-curve between two frames, beside an evaluation of the whole curve written from Blender's manual."""

import numpy as np
import pytest
from scipy.optimize import brentq

from blender.caesura_addon.key_cut import BEZIER, CONSTANT, LINEAR, Keys, baked_keys, cut_keys

EASING = 5


def curve(seed, kinds=(BEZIER,), count=9):
    """A curve with a key every few frames, and handles of any length that its frames allow."""
    rng = np.random.default_rng(seed)
    frames = np.cumsum(rng.integers(3, 12, count)).astype(float)
    co = np.stack([frames, rng.normal(size=count)], axis=1)
    reach = np.stack([rng.uniform(0.5, 6, count), rng.normal(size=count)], axis=1)
    ints = np.full(count, 4, np.int32)
    return Keys(co, co - reach, co + reach[::-1], rng.choice(kinds, count).astype(np.int32), ints, ints.copy())


def value(keys, frame):
    """The curve at a frame: by the root of its cubic, and not by halving."""
    frames = keys.co[:, 0]
    if frame <= frames[0]:
        return keys.co[0, 1]
    if frame >= frames[-1]:
        return keys.co[-1, 1]
    at = int(np.searchsorted(frames, frame, side="right")) - 1
    a, b, length = keys.co[at], keys.co[at + 1], frames[at + 1] - frames[at]
    if keys.interpolation[at] == CONSTANT:
        return a[1]
    if keys.interpolation[at] == LINEAR:
        return a[1] + (b[1] - a[1]) * (frame - a[0]) / length
    right, left = keys.right[at] - a, keys.left[at + 1] - b
    right, left = (reach * min(1, length / max(abs(reach[0]), 1e-30)) for reach in (right, left))
    points = np.stack([a, a + right, b + left, b])

    def place(t):
        return np.array([(1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t**2, t**3]) @ points

    return place(brentq(lambda t: place(t)[0] - frame, 0, 1, xtol=1e-14))[1]


def test_handles_that_blender_would_shorten_in_a_part_are_left_to_be_evaluated():
    co = np.array([[0.0, 0.0], [10.0, 1.0]])
    ints = np.full(2, BEZIER, np.int32)
    reach = np.array([10.0, 0.0])
    keys = Keys(co, co - reach, co + reach, ints, ints.copy(), ints.copy())
    assert cut_keys(keys, 3, 10) is None
    short = Keys(co, co - 0.3 * reach, co + 0.3 * reach, ints, ints.copy(), ints.copy())
    assert value(cut_keys(short, 3, 10), 2) == pytest.approx(value(short, 5))


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("kinds", [(BEZIER,), (LINEAR,), (CONSTANT,), (BEZIER, LINEAR, CONSTANT)])
def test_a_part_is_the_whole_curve_there(seed, kinds):
    keys = curve(seed, kinds)
    last = int(keys.co[-1, 0])
    for start, end in ((0, last + 9), (0, 2), (last - 2, last + 5), (last + 1, last + 9), (7, 8), (10, 31), (5, last)):
        part = cut_keys(keys, start, end)
        if part is None:  # long handles
            continue
        assert part.co[:, 0].min() >= -1e-9
        assert part.co[:, 0].max() <= max(end - start, 0) + 1e-9
        for frame in np.arange(start, end, 0.5):
            assert value(part, frame - start) == pytest.approx(value(keys, frame), abs=1e-7), (start, end, frame)


def test_parts_side_by_side_have_every_key_once_and_share_the_pose_between_them():
    keys = curve(1)
    middle = keys.co[4, 0] + 1
    before, after = cut_keys(keys, 0, middle), cut_keys(keys, middle, keys.co[-1, 0])
    assert len(before) + len(after) == len(keys) + 2
    assert before.co[-1, 1] == pytest.approx(after.co[0, 1])


def test_the_curve_that_is_cut_stays_as_it_was():
    keys = curve(2)
    copy = keys.part(0, len(keys))
    cut_keys(keys, 6, 17)
    assert all(
        np.array_equal(getattr(keys, name), getattr(copy, name)) for name in ("co", "left", "right", "left_type")
    )


def test_an_easing_that_would_be_split_is_left_to_be_evaluated():
    keys = curve(3, (EASING,))
    assert cut_keys(keys, keys.co[2, 0] + 1, keys.co[4, 0]) is None
    assert len(cut_keys(keys, keys.co[2, 0], keys.co[4, 0])) == 3


def test_baked_keys_are_straight_and_on_every_frame():
    baked = baked_keys([1.0, 3.0, 2.0])
    assert [value(baked, frame) for frame in (0, 0.5, 1, 2)] == [1, 2, 3, 2]
