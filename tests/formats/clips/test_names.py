"""Names that every engine and file system takes."""

import pytest

from caesura.core.errors import ParameterError
from caesura.formats.clips.clip_names import number_repeated_names, safe_name
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
    assert safe_name(name) == expected


def test_names_are_numbered_by_motion_and_unique_in_any_case():
    """Two motions that differ in case alone share their numbers; names that are taken are passed over."""
    motions = [("walk", False), ("Walk", False), ("run", True), ("walk", False)]
    assert number_repeated_names(motions, taken=["WALK_01"]) == ["walk_02", "Walk_03", "run_01-loop", "walk_04"]
    assert number_repeated_names([("A", False)] * 100, taken=[])[-1] == "A_100"


def test_options_are_read_back_from_their_canonical_text():
    """What a job is called says all that was chosen, and nothing that was not."""
    chosen = ClipOptions(keep_source=True, handles_seconds=0.25, loop="walk, run & jump")
    assert ClipOptions.parse(chosen.canonical()) == chosen
    assert ClipOptions().canonical() == ""
    with pytest.raises(ParameterError) as refused:
        ClipOptions.of({"min_seconds": -1})
    assert refused.value.where == {"parameter": "min_seconds"}
