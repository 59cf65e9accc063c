"""Collections: one set of motions over takes of one body, takes added and removed, and what people say of segments."""

from dataclasses import replace

import numpy as np
import pytest

from caesura.core.agreement import rand_index
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.together.body_poses import BodyPoses, measure_poses
from caesura.core.together.collection_file import collection_from_bytes, collection_to_bytes
from caesura.core.together.corrections import apply_changes, correct_segment
from caesura.core.together.duplicates import best_segments, find_duplicates
from caesura.core.together.linkage import conflict_share, link_segments
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.segment_together import segment_together
from caesura.core.together.take_labelling import label_take, remove_take
from tests.animations import animation, bar, performing_bar
from tests.core.together.bars import bar_take, renamed, truths

ORDERS = ([0, 1, 2, 0], [2, 0, 1], [1, 3, 2])


@pytest.fixture(scope="module")
def takes():
    """Three performers of other sizes, who look elsewhere, at other rates; one motion is in one take only."""
    return [
        bar_take("first", ORDERS[0]),
        bar_take("second", ORDERS[1], size=3.0, angle=1.0, rate=24.0),
        bar_take("third", ORDERS[2], size=0.01, angle=2.5, rate=60.0),
    ]


@pytest.fixture(scope="module")
def collection(takes):
    """The three together."""
    return segment_together(takes)


def motions(collection):
    return np.array([segment.motion for segment in collection.segments])


@pytest.mark.parametrize("told", ["auto", 4])
def test_a_motion_is_one_motion_in_every_take(takes, told):
    """Whoever performs it, how large, where and at what rate."""
    found = segment_together(takes, told)
    assert rand_index(motions(found), truths(*ORDERS)) == 1.0
    assert [motion.takes for motion in found.motions] == [2, 3, 3, 1]


def test_the_order_of_takes_does_not_matter(takes, collection):
    """But for the numbers of motions, which are in order of appearance."""
    found = segment_together(takes[::-1])
    for take in takes:
        assert rand_index(found.labels(take.name), collection.labels(take.name)) == 1.0


def test_labels_tile_every_take(takes, collection):
    """Every frame has a motion, and the motions' seconds are those of all takes."""
    assert [len(collection.labels(take.name)) for take in takes] == [take.poses.frames for take in takes]
    assert sum(motion.seconds for motion in collection.motions) == pytest.approx(sum(take.seconds for take in takes))


def test_a_collection_is_the_same_after_a_file(collection):
    """Every value survives."""
    again = collection_from_bytes(collection_to_bytes(collection))
    assert again.segments == collection.segments
    assert again.document() == collection.document()
    np.testing.assert_array_equal(again.space.directions, collection.space.directions)


def test_a_take_is_nearly_the_same_after_a_file(takes):
    """Poses are kept to half precision."""
    again = MeasuredTake.from_bytes(takes[0].to_bytes())
    assert (again.name, again.poses.names, again.poses.stride) == ("first", takes[0].poses.names, takes[0].poses.stride)
    np.testing.assert_allclose(again.poses.places, takes[0].poses.places, atol=2e-3)


def test_takes_of_two_topologies_are_refused_with_what_differs(takes):
    """The refusal names both, and their vertices."""
    rest, triangles = bar(rings=9)
    other = measure_poses(animation(np.stack([rest, rest * 1.1]), triangles))
    stranger = MeasuredTake("stranger", other, np.array([0, 2]), np.array([0]), np.array([1]))
    with pytest.raises(InvalidModel, match=r"first has 96 vertices.*stranger has 72 vertices") as refused:
        segment_together([takes[0], stranger])
    assert refused.value.code == "not-comparable"


def test_joints_are_told_by_name_in_any_order(takes):
    """A name space before a name and its capitals do not matter; a joint more does not either, three others do."""
    plain = takes[0].poses
    names = tuple(f"joint {i}" for i in range(len(plain.names)))
    order = np.random.default_rng(0).permutation(len(names))
    first = replace(takes[0], poses=replace(plain, kind="joints", names=names, topology=""))
    shuffled = replace(first.poses, names=tuple(names[i] for i in order), places=plain.places[:, order])
    found = segment_together([first, replace(first, name="shuffled", poses=shuffled)])
    np.testing.assert_array_equal(found.labels("first"), found.labels("shuffled"))
    strange = replace(first.poses, names=(*(f"bone {i}" for i in range(40)), *names[40:]))
    with pytest.raises(InvalidModel, match="strange lacks 'joint 0', 'joint 1'"):
        segment_together([first, replace(first, name="strange", poses=strange)])


def test_takes_without_names_of_their_own_are_refused(takes):
    """And so is no take at all, or no motion."""
    with pytest.raises(ParameterError, match="Two takes are called 'first'"):
        segment_together([takes[0], takes[0]])
    with pytest.raises(ParameterError, match="no take"):
        segment_together([])
    with pytest.raises(ParameterError, match="motions = 0"):
        segment_together(takes, 0)


def test_a_take_added_is_labelled_by_the_motions_known(takes):
    """What is none of them is new; nothing that was there changes, nor do names."""
    known = segment_together(takes[:2]).with_name(1, "sway")
    update = label_take(known, takes[2])
    assert update.collection.segments[: len(known.segments)] == known.segments
    assert dict(update.collection.names) == {1: "sway"}
    assert rand_index(motions(update.collection), truths(*ORDERS)) == 1.0
    assert update.new_motions == (known.next_id,)
    assert [change.before for change in update.changes] == [None, None, None]
    with pytest.raises(ParameterError, match="has a take 'third' already"):
        label_take(update.collection, takes[2])


def test_a_take_removed_leaves_nothing(takes, collection):
    """Its motions go with it where nobody else performs them, and their numbers are not used again."""
    update = remove_take(collection, "third")
    assert {segment.take for segment in update.collection.segments} == {"first", "second"}
    assert len(update.gone_motions) == 1
    again = label_take(update.collection, takes[2])
    assert again.new_motions == (collection.next_id,)
    with pytest.raises(ParameterError, match="no take 'third'"):
        remove_take(update.collection, "third")


def test_a_correction_proposes_the_same_for_others_alike(takes):
    """It is done for one segment, and only proposed for those that are like it."""
    merged = segment_together([*takes, renamed(takes[1], "fourth")])
    swayed = merged.of_take("second")[2].motion
    bent = merged.of_take("second")[1].motion
    wrong = replace(
        merged,
        segments=tuple(replace(one, motion=bent) if one.motion == swayed else one for one in merged.segments),
    )
    update = correct_segment(wrong, "second", wrong.of_take("second")[2].start, is_motion=wrong.next_id)
    (change,) = update.changes
    assert (change.before, change.after) == (bent, wrong.next_id)
    assert update.new_motions == (wrong.next_id,)
    right = {(one.take, one.start) for one in merged.segments if one.motion == swayed} - {("second", change.start)}
    assert {(one.take, one.start) for one in update.proposals} == right
    done = apply_changes(update.collection, update.proposals).collection
    assert rand_index(motions(done), motions(merged)) == 1.0
    assert sum(one.fixed for one in done.segments) == 1 + len(right)


def test_a_motion_that_a_person_refused_is_not_proposed_again(collection):
    """The segment goes to the next like it, and remembers what it is not."""
    first = collection.of_take("first")[0]
    update = correct_segment(collection, "first", 0, is_not=first.motion)
    changed = update.collection.of_take("first")[0]
    assert changed.motion != first.motion
    assert changed.refused == (first.motion,)
    assert changed.fixed
    with pytest.raises(ParameterError, match="no motion 99"):
        correct_segment(collection, "first", 0, is_motion=99)
    with pytest.raises(ParameterError, match="begins at frame 7"):
        correct_segment(collection, "first", 7, is_motion=0)


def test_a_take_saved_twice_is_marked(takes):
    """Every segment of the second is the same as one of the first; of each motion one is the best."""
    twice = segment_together([*takes, renamed(takes[1], "copy")])
    again = find_duplicates(twice)
    assert {twice.segments[i].take for i in again} == {"copy"}
    assert {twice.segments[i].take for i in again.values()} == {"second"}
    assert len(again) == takes[1].segments
    assert len(best_segments(twice)) == len(twice.motions)


def test_takes_beyond_what_is_linked_at_once_are_labelled(takes, monkeypatch):
    """With room for one take, the others come to its motions."""
    monkeypatch.setattr("caesura.core.together.segment_together.MOST_LINKED", 5)
    found = segment_together([*takes[:2], renamed(takes[0], "again")])
    assert len(found.takes) == 3
    np.testing.assert_array_equal(found.labels("first"), found.labels("again"))


def test_one_group_is_one_motion():
    """A single segment is linked to nothing; groups that a take keeps apart are in conflict by their share."""
    assert link_segments(np.zeros((1, 1)), np.zeros(1, np.int64), np.zeros(1, np.int64), None).tolist() == [0]
    takes, own = np.array([0, 0, 1, 2]), np.array([0, 1, 0, 0])
    assert conflict_share(np.array([0, 2]), np.array([1, 3]), takes, own) == 0.5
    assert conflict_share(np.array([0]), np.array([2]), takes, own) == 0.0


def test_a_body_of_two_points_cannot_be_compared():
    """Two points are at the same place in every pose but for the size."""
    with pytest.raises(InvalidModel, match="2 points") as refused:
        measure_poses(animation(np.zeros((4, 2, 3)), []))
    assert refused.value.code == "not-comparable"


def test_poses_that_are_nowhere_are_refused_by_frame():
    """The frame is named, whatever the stride."""
    made = performing_bar([0], seconds=1.0, rings=3).animation
    vertices = np.array(made.vertices(0, made.frames))
    vertices[10] = np.nan
    with pytest.raises(InvalidModel, match="no place") as refused:
        measure_poses(animation(vertices, made.triangles))
    assert refused.value.where["frame"] == 10


def test_poses_have_no_place_heading_or_size(takes):
    """The median pose has unit size and its mean at the origin."""
    places = takes[2].poses.places
    assert isinstance(takes[2].poses, BodyPoses)
    np.testing.assert_allclose(places.mean(axis=1), 0, atol=1e-4)
    median = np.median(places, axis=0)
    assert np.sqrt((median**2).sum(axis=1).mean()) == pytest.approx(1.0, abs=0.01)
