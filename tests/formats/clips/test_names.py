"""Names that every engine and file system takes."""

import pytest

from caesura.core.errors import ParameterError
from caesura.formats.clips.clip_names import ClipSubject, engine_safe_name, name_clips, name_clips_of_motions
from caesura.formats.clips.clip_options import ClipOptions


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("walk", "walk"),
        ("a/b.c:d[e] f", "a_b_c_d_e_f"),
        ("../..", "motion"),
        ("", "motion"),
        ("跳ぶ", "跳ぶ"),
        ("-x-", "x"),
    ],
)
def test_what_means_something_to_an_engine_is_left_out(name, expected):
    """Letters of any script, digits, dashes and underscores stay."""
    assert engine_safe_name(name) == expected


def test_names_are_numbered_by_motion_and_unique_in_any_case():
    """Two motions that differ in case alone share their numbers; names that are taken are passed over."""
    motions = [("walk", False), ("Walk", False), ("run", True), ("walk", False)]
    assert name_clips_of_motions(motions, taken=["WALK_01"]) == ["walk_02", "Walk_03", "run_01-loop", "walk_04"]
    assert name_clips_of_motions([("A", False)] * 100, taken=[])[-1] == "A_100"


def test_names_follow_a_pattern_and_stay_unique():
    """A pattern without a number gets one where two would be the same; what is unsafe in it is replaced."""
    walk, run = ClipSubject("walk", 1, "Take 1"), ClipSubject("run", 2, "Take 1", loops=True)
    pattern = "hero/{take}/{motion} {segment}"
    assert name_clips([walk, run], (), pattern) == ["hero_Take_1_walk_01", "hero_Take_1_run_02-loop"]
    assert name_clips([walk, walk, run], ["walk"], "{motion}") == ["walk_02", "walk_03", "run-loop"]
    assert name_clips([walk, run, walk], (), "clip") == ["clip", "clip-loop", "clip_02"]


@pytest.mark.parametrize(
    "pattern", ["{name}", "{motion.__class__}", "{motion!r}", "{number:>999}", "{", "}", "{}", " "]
)
def test_a_pattern_holds_what_there_is(pattern):
    """Anything else in braces is refused, with what there is."""
    with pytest.raises(ParameterError, match="motion"):
        ClipOptions.of({"names": pattern})


def test_segments_are_chosen_by_number():
    """One by one and from one to another; all where none is named."""
    chosen = ClipOptions.of({"only": "2,4-6"})
    assert [n for n in range(1, 9) if chosen.chooses(n)] == [2, 4, 5, 6]
    assert ClipOptions().chooses(99)
    with pytest.raises(ParameterError):
        ClipOptions.of({"only": "2-"})


def test_options_are_read_back_from_their_canonical_text():
    """What a job is called says all that was chosen, and nothing that was not."""
    chosen = ClipOptions(keep_source=True, handles_seconds=0.25, loop="walk, run & jump")
    assert ClipOptions.parse(chosen.canonical()) == chosen
    assert ClipOptions().canonical() == ""
    with pytest.raises(ParameterError) as refused:
        ClipOptions.of({"min_seconds": -1})
    assert refused.value.where == {"parameter": "min_seconds"}
