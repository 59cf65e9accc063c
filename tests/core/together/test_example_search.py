"""Search by example: bent in time, mirrored, and the same as a slow twin."""

import numpy as np
import pytest

from caesura.core.errors import ParameterError
from caesura.core.kernels.time_warping import warp_onto_ranges
from caesura.core.together.body_poses import BodyPoses, align_poses
from caesura.core.together.example_search import ExampleIndex
from caesura.core.together.mirror_symmetry import find_mirror_symmetry
from caesura.core.together.motion_signature import MotionSignatures, matrix_roots
from caesura.core.together.pose_space import PoseSpace

RATE = 15.0
BODY = np.array(
    [[0, 0, 0], [0, 1, 0.05], [0, 2, 0], [0, 2.5, 0.1]]
    + [
        [side * x, y, z]
        for side in (1, -1)
        for x, y, z in ((0.4, 2, 0), (0.8, 1.6, 0.1), (0.9, 1.1, 0), (0.3, -1, 0.2))
    ],
    float,
)


def poses(*swings, seconds=6.0):
    """A figure that swings its arms, each (frames a second of swinging, amplitude of the left, and of the right)."""
    parts = []
    for speed, left, right in swings:
        time = np.arange(round(seconds * RATE)) / RATE
        swing = np.sin(2 * np.pi * speed * time) ** 2
        body = np.repeat(BODY[None], len(time), axis=0)
        for arm, amount in (((5, 6), left), ((9, 10), right)):
            for depth, point in enumerate(arm, start=1):
                body[:, point, 1] += depth * amount * swing
                body[:, point, 2] += depth * 0.5 * amount * swing**2
        parts.append(body)
    places = align_poses(np.concatenate(parts).astype(np.float32))
    names = tuple(f"joint {i}" for i in range(len(BODY)))
    return BodyPoses("joints", names, "", places, len(places), RATE, 1)


LEFT, RIGHT, BOTH, STILL = (0.4, 0.6, 0.0), (0.4, 0.0, 0.6), (0.4, 0.6, 0.6), (0.4, 0.02, 0.02)


@pytest.fixture(scope="module")
def index():
    """One performer of the left hand, one of the right, and one who is slower."""
    slow = (0.25, 0.6, 0.0)
    takes = [("left", poses(STILL, LEFT, BOTH)), ("right", poses(BOTH, RIGHT, STILL)), ("slow", poses(slow, BOTH))]
    return ExampleIndex.of(PoseSpace.learn(takes), takes)


def test_left_and_right_are_found_in_the_poses_alone(index):
    """The plane between them, and who is whose counterpart."""
    found = find_mirror_symmetry([BODY])
    assert found is not None
    assert abs(found.normal[0]) == pytest.approx(1.0, abs=1e-6)
    np.testing.assert_array_equal(found.counterpart, [0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7])
    assert index.space.mirrors
    crooked = np.random.default_rng(0).normal(size=(12, 3))
    assert find_mirror_symmetry([crooked]) is None


def test_an_example_finds_the_other_hand_and_the_slower_performer(index):
    """The nearest ranges are of the same motion, mirrored or slower, and none of another."""
    example = index.example("left", round(6 * RATE), round(8.5 * RATE))
    found = [one for one in index.find(example, 12) if one.distance < 0.1]
    assert {one.take for one in found} == {"left", "right", "slow"}
    assert {one.mirrored for one in found if one.take == "right"} == {True}
    for one in found:
        start, end = {"left": (6, 12), "right": (6, 12), "slow": (0, 6)}[one.take]
        assert start * RATE - RATE <= one.start
        assert one.end <= end * RATE + RATE
    assert max(one.end - one.start for one in found if one.take == "slow") > 1.4 * len(example) * index.takes[0].stride


def test_a_range_finds_itself_first(index):
    """At no distance; and ranges that it overlaps by half are not told again."""
    found = index.find(index.example("left", 100, 140), 20)
    assert (found[0].take, found[0].distance < 1e-4) == ("left", True)
    for i, one in enumerate(found):
        for other in found[:i]:
            shared = min(one.end, other.end) - max(one.start, other.start)
            shorter = min(one.end - one.start, other.end - other.start)
            assert one.take != other.take or shared < 0.5 * shorter + 2 * index.takes[0].stride


def test_the_answer_does_not_depend_on_threads(index):
    """The same ranges in the same order."""
    example = index.example("right", 95, 140)
    assert index.find(example, 10, threads=1) == index.find(example, 10, threads=3)


def test_a_take_that_has_gone_is_found_no_more(index):
    """And one that is not there, or a range outside of it, is no example."""
    example = index.example("slow", 0, 60)
    assert {one.take for one in index.without_take("slow").find(example, 50)} == {"left", "right"}
    with pytest.raises(ParameterError, match="no take 'gone'"):
        index.example("gone", 0, 60)
    with pytest.raises(ParameterError, match="no range to search by"):
        index.example("slow", 100, 100_000)


def test_warping_is_what_a_slow_twin_finds():
    """Every path is tried by recursion, on small costs."""
    costs = np.random.default_rng(1).random((9, 4)).astype(np.float32)
    total, begins = np.empty(9, np.float32), np.empty(9, np.int32)
    warp_onto_ranges(costs, 0.05, total, begins)

    def least(step, sample):
        if step < 0:
            return np.inf, 0
        if sample == 0:
            return float(costs[step, 0]), step
        paths = [(least(step - 1, sample - 1), float(costs[step, sample]))]
        if sample > 1 and step > 0:
            paths.append((least(step - 1, sample - 2), float(costs[step, sample - 1] + costs[step, sample]) + 0.05))
        if step > 1:
            paths.append((least(step - 2, sample - 1), float(costs[step - 1, sample] + costs[step, sample]) / 2 + 0.05))
        return min((cost + more, begin) for (cost, begin), more in paths)

    for step in range(9):
        cost, begin = least(step, 3)
        if np.isfinite(cost):
            assert total[step] == pytest.approx(cost / 4, rel=1e-5)
            assert begins[step] == begin
        else:
            assert np.isinf(total[step])


def test_a_signature_does_not_know_the_phase_and_knows_the_side(index):
    """Two stretches of one motion are alike from wherever they begin; the other hand costs the penalty alone."""
    track = index.space.track("left", poses(STILL, LEFT, BOTH))
    other = index.space.track("right", poses(STILL, RIGHT, BOTH))
    ranges = np.array([[95, 170], [103, 178], [182, 260]])
    signed = [MotionSignatures.of(one, index.space.speeds(one, RATE), RATE, ranges) for one in (track, other)]
    spreads = signed[0].spreads()
    apart = signed[0].distances(signed[0], spreads, index.space.signs)
    assert apart[0, 1] < 0.05 * apart[0, 2]
    mirrored = signed[0].distances(signed[1], spreads, index.space.signs)
    assert mirrored[0, 0] < 0.15 * apart[0, 2]
    roots = matrix_roots(np.array([[[4.0, 0.0], [0.0, 9.0]]]))
    np.testing.assert_allclose(roots, [[[2, 0], [0, 3]]])
