"""Takes: motions one after the other, on the ground, with the truth of where each begins."""

import numpy as np
import pytest

from caesura.samples.ground import SOLE, feet_to_ground
from caesura.samples.repertoire import MOTIONS
from caesura.samples.skeleton import HUMAN
from caesura.samples.take import FADE, RATE, Part, perform


def take(*motions, seed=3):
    """A take of these motions, each so often."""
    random = np.random.default_rng(seed)
    return perform([Part(MOTIONS[m], MOTIONS[m].ends(times, RATE, random)) for m, times in motions], random)


def soles(performed):
    """Heels and balls of both feet in the world, by frame."""
    world = np.empty((len(performed.places), len(HUMAN.names), 3, 3))
    places = np.empty(world.shape[:-1])
    for joint, parent in enumerate(HUMAN.parents):
        x, y, z, w = performed.rotations[joint].T
        local = np.moveaxis(
            np.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                ]
            ),
            -1,
            0,
        )
        world[:, joint] = local if parent < 0 else world[:, parent] @ local
        above = performed.places if parent < 0 else places[:, parent] + world[:, parent] @ HUMAN.offsets[joint]
        places[:, joint] = above
    points = [(HUMAN.index(name + side), offset) for side in (".L", ".R") for name, offset in SOLE]
    return np.stack([places[:, joint] + world[:, joint] @ np.array(offset) for joint, offset in points], axis=1)


def test_the_truth_tiles_the_take():
    """Segments follow each other without gap or overlap, in the order of the motions."""
    truth = take(("walk", 3), ("wave", 4), ("walk", 2)).truth
    starts, ends = [s for _, s, _ in truth.segments], [e for _, _, e in truth.segments]
    assert [label for label, _, _ in truth.segments] == ["walk", "wave", "walk"]
    assert starts == [0, *ends[:-1]]
    assert ends[-1] == truth.frames


def test_the_truth_says_how_often_each_motion_is_performed():
    """And where each repetition ends: they tile their segment."""
    truth = take(("walk", 3), ("wave", 4), ("bow", 1)).truth
    assert [len(ends) for ends in truth.repeats] == [3, 4, 1]
    assert [ends[-1] for ends in truth.repeats] == [end for _, _, end in truth.segments]
    first = truth.document()["segments"][0]["repeats"]
    assert first[0] == {"start": 0, "end": truth.repeats[0][0]}


def test_a_motion_begins_in_the_middle_of_its_cross_fade():
    """Outside the half second around a cut there is one motion alone: the arm is down before and up after."""
    performed = take(("squat", 1), ("wave", 3))
    cut = performed.truth.segments[1][1]
    arm = performed.rotations[HUMAN.index("upper_arm.R")]
    turned = 2 * np.degrees(np.arccos(np.clip(np.abs((arm * arm[cut - FADE - 1]).sum(axis=1)), 0, 1)))
    assert turned[cut - FADE - 4 : cut - FADE].max() < 10
    assert turned[cut + FADE :].min() > 50
    assert 15 < turned[cut] < turned[cut + FADE]


@pytest.mark.parametrize("motion", ["walk", "squat", "sneak", "march"])
def test_feet_stay_on_the_ground(motion):
    """The lower foot is on the ground, and hardly slides while it carries."""
    points = soles(take((motion, 5)))
    assert np.abs(points[..., 1].min(axis=1)).max() < 0.02
    low = points[1:, :, 1] < 0.004
    slide = np.linalg.norm(np.diff(points[..., [0, 2]], axis=0), axis=2)
    assert np.median(slide[low]) < 0.01


def test_walking_leads_somewhere_and_jumping_off_the_ground():
    """A walk covers ground at a walker's pace; a jump leaves it."""
    walk, jump = take(("walk", 6)), take(("jump", 2))
    steps = np.linalg.norm(np.diff(walk.places[:, [0, 2]], axis=0), axis=1)
    assert 0.8 < steps.mean() * RATE < 2.0
    assert soles(jump)[..., 1].min(axis=1).max() > 0.2


def test_ankles_level_the_soles():
    """With a raised thigh and a bent knee, a sole told to be level is level."""
    angles = np.zeros((1, len(HUMAN.names), 3))
    angles[0, HUMAN.index("thigh.L"), 0], angles[0, HUMAN.index("shin.L"), 0] = 50.0, 70.0
    world, _ = HUMAN.pose(feet_to_ground(angles))
    assert np.allclose(world[0, HUMAN.index("foot.L")] @ [0, 0, 1], [0, 0, 1], atol=1e-9)


def test_the_same_seed_gives_the_same_take():
    """And another seed another."""
    one, two, other = (take(("kick", 2), ("clap", 3), seed=seed) for seed in (1, 1, 2))
    assert np.array_equal(one.rotations, two.rotations)
    assert one.rotations.shape != other.rotations.shape or not np.allclose(one.rotations, other.rotations)
