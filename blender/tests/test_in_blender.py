"""The add-on in Blender, against a running service: `make addon-test`."""

import re

import pytest

FIRST, LAST = 11, 280
CUTS = (101, 191)
NEAR = 10
FLOAT = 2e-5
"""Blender's own arithmetic is float32, and a chain of bones adds up."""


def cuts_of(markers):
    return [frame for name, frame in markers if name != "mine"]


def check_found(seen):
    frames = cuts_of(seen["markers"])
    assert frames == [FIRST, *(pytest.approx(cut, abs=NEAR) for cut in CUTS)]
    assert ["mine", 100] in seen["markers"]
    assert [strip[0] for strip in seen["strips"]] == seen["actions"] == ["A_01", "B_01", "C_01"]
    assert [strip[1] for strip in seen["strips"]] == frames
    assert [strip[2] for strip in seen["strips"]] == [*frames[1:], LAST]
    assert seen["difference"] < FLOAT
    assert seen["frame"] == 77
    assert seen["others"] == []


def test_cuts_are_markers_and_named_actions_that_play_as_the_take_did(journey):
    check_found(journey("found_motions"))


def test_an_action_that_is_cut_between_its_keys_plays_as_the_take_did_with_few_keys(journey):
    seen = journey("sparse_keys")
    check_found(seen)
    assert max(seen["keys"]) < 20


def test_the_number_of_motions_is_changed_and_undone_in_place(journey):
    seen = journey("changed_and_undone")
    assert len({name for name, _ in seen["first"]}) == 3
    assert len({name for name, _ in seen["second"]}) == 2
    assert seen["third"] == seen["first"]
    assert seen["same strips"]
    assert seen["difference"] < FLOAT
    assert seen["blenders"] == seen["first"]  # two steps of Blender's own undo: the panel's undo, and the change


def test_markers_that_are_moved_renamed_and_deleted_are_saved_as_revisions(journey, service):
    seen = journey("corrected")
    assert [name for name, _ in seen["renamed"] if name != "mine"] == ["walk", "B", "C"]
    assert seen["looped"] == ["walk_01-loop"]
    assert [strip[0] for strip in seen["strips"]] == ["walk_01-loop", "turn_01"]  # C is discarded
    assert [strip[3] for strip in seen["strips"]] == [True, False]
    assert ["turn", FIRST + 80] in seen["markers"]
    assert ["mine", 50] in seen["merged"]
    assert seen["difference"] < FLOAT
    segmentation = seen["segmentation"]
    assert seen["revision"] == {segmentation: 1}
    first, second = (
        service.http.get(f"/v1/segmentations/{segmentation}/revisions/{number}").json()["segments"] for number in (1, 2)
    )
    assert [(s["start"], s["name"], s["loop"], s["discard"]) for s in first][:2] == [
        (0, "walk", True, False), (80, "turn", False, False),
    ]  # fmt: skip
    assert (first[2]["name"], first[2]["discard"]) == ("C", True)
    assert [s["name"] for s in second] == ["walk", "C"]
    assert seen["discards"] == [False, True]


def test_what_is_removed_leaves_the_take_as_it_was(journey):
    seen = journey("removed")
    assert seen["same things"]
    assert seen["action"]
    assert (seen["markers"], seen["tracks"]) == ([], 0)
    assert seen["difference"] == 0


def test_a_mesh_is_sent_by_its_vertices_and_its_armatures_action_is_cut(journey):
    seen = journey("of_a_mesh")
    assert cuts_of(seen["markers"]) == [FIRST, *(pytest.approx(cut, abs=NEAR) for cut in CUTS)]
    assert len(seen["strips"]) == 3


def test_the_action_of_shape_keys_is_cut(journey):
    seen = journey("of_shape_keys")
    assert cuts_of(seen["markers"]) == [FIRST, *(pytest.approx(cut, abs=NEAR) for cut in CUTS)]
    assert [strip[0] for strip in seen["strips"]] == ["A_01 shapes", "B_01 shapes", "C_01 shapes"]
    assert seen["difference"] < FLOAT


def test_what_is_cancelled_leaves_nothing(journey):
    seen = journey("cancelled")
    assert seen["stages"] == ["reading frames", "cutting actions"]
    assert seen["same things"]
    assert seen["markers"] == []


def test_a_service_that_does_not_answer_is_said_and_nothing_changes(journey):
    seen = journey("without_a_service", "http://127.0.0.1:9")
    assert seen["said"].startswith("No answer from http://127.0.0.1:9")
    assert seen["same things"]
    assert seen["markers"] == []


def test_nothing_is_sent_away_where_blenders_user_allows_no_network(journey):
    seen = journey("away_without_online_access")
    assert "Allow Online Access" in seen["said"]
    assert seen["same things"]


def test_a_local_service_is_started_and_ends_with_the_add_on(journey, command, tmp_path):
    seen = journey("local_service", command, CAESURA_DATA_DIR=str(tmp_path / "data"))
    assert len(cuts_of(seen["markers"])) == 3
    assert seen["ran"]
    assert seen["ended"]


@pytest.mark.timeout(900)
def test_a_take_of_forty_minutes_holds_the_main_thread_for_less_than_100_ms(blender, extension, service, capsys):
    lines = blender("responsiveness.py", extension, service.url, 72_000, seconds=800)
    with capsys.disabled():  # a figure to read, not only to pass
        print("", *lines, sep="\n")
    milliseconds = re.search(r"main thread takes [\d.]+ ms, of the processor ([\d.]+) ms", lines[-1])
    assert milliseconds
    assert float(milliseconds[1]) < 100, lines
