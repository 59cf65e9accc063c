"""Markers and segments of the Blender add-on: what a person does to markers is what the revision says."""

from blender.caesura_addon.segments import (
    Mark,
    Segment,
    clip_names,
    marks_of_segments,
    motion_names,
    own_marks,
    revision_of_segments,
    segments_of_marks,
)
from caesura.core.revision import Edit, check_edits

FIRST, FRAMES = 101, 100
FOUND = [Segment(0, 30, "A"), Segment(30, 60, "B"), Segment(60, 100, "A")]


def read(marks, **flags):
    return segments_of_marks(marks, FIRST, FRAMES, **flags)


def test_markers_that_nobody_touched_are_the_segments():
    marks = marks_of_segments(FOUND, FIRST)
    assert marks == [Mark("A", 101), Mark("B", 131), Mark("A", 161)]
    assert read(marks) == FOUND
    assert read(reversed(marks)) == FOUND


def test_a_marker_that_is_moved_moves_the_cut():
    assert read([Mark("A", 101), Mark("B", 140), Mark("A", 161)])[0].end == 39


def test_a_marker_that_is_deleted_merges_with_the_segment_before_it():
    assert read([Mark("A", 101), Mark("A", 161)]) == [Segment(0, 60, "A"), Segment(60, 100, "A")]


def test_a_marker_that_is_renamed_makes_its_segment_one_of_another_motion():
    found = read([Mark("A", 101), Mark(" kick ", 131), Mark("A", 161)])
    assert motion_names(found) == ["A", "kick"]


def test_a_marker_that_is_added_is_a_cut():
    assert read([Mark("A", 101), Mark("new", 111), Mark("B", 131), Mark("A", 161)])[1] == Segment(10, 30, "new")


def test_the_first_segment_begins_with_the_take_wherever_its_marker_stands():
    assert read([Mark("A", 110), Mark("B", 131)]) == [Segment(0, 30, "A"), Segment(30, 100, "B")]
    assert read([Mark("B", 131)]) == [Segment(0, 100, "B")]


def test_markers_outside_the_take_and_no_markers_at_all_still_tile_it():
    assert read([Mark("A", 101), Mark("B", 201), Mark("C", 100)]) == [Segment(0, 100, "A")]
    assert read([]) == [Segment(0, 100, "A")]


def test_of_two_markers_on_one_frame_the_last_counts():
    assert read([Mark("A", 101), Mark("B", 131), Mark("C", 131)])[1].name == "C"


def test_loops_and_discards_go_by_the_name_of_the_motion():
    found = read(marks_of_segments(FOUND, FIRST), loops=["A"], discards=["B"])
    assert [(s.loop, s.discard) for s in found] == [(True, False), (False, True), (True, False)]


def test_markers_that_were_there_before_are_nobodys_cuts_also_after_they_were_moved():
    others = [Mark("camera", 120), Mark("A", 150)]
    marks = [Mark("camera", 155), Mark("A", 150), Mark("A", 101), Mark("B", 131)]
    assert own_marks(marks, others, ["A", "B"]) == [Mark("A", 101), Mark("B", 131)]


def test_the_service_takes_the_revision_of_any_markers():
    for marks in ([Mark("A", 101), Mark("walk", 120), Mark("A", 130), Mark("walk", 131)], [], [Mark("x", 199)]):
        edits = revision_of_segments(read(marks))
        checked = check_edits([Edit.model_validate(edit) for edit in edits], FRAMES)
        assert [edit.name for edit in checked] == [edit["name"] for edit in edits]


def test_clips_are_called_by_motion_and_number():
    assert clip_names(FOUND) == ["A_01", "B_01", "A_02"]
