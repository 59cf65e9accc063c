"""The result: labels in order of appearance, segments that tile, and a document that says the same."""

import json

import numpy as np
import pytest

from caesura.core.document import Source, motion_name
from caesura.core.segmentation import Segmentation, number_by_appearance


@pytest.fixture
def result():
    """Ten frames at 5 a second: two of motion 0, five of 1, three of 0 again; starting at 2 s."""
    return Segmentation(
        method="joint-entropy",
        algorithm="1",
        parameters={},
        source=Source(take=0, name="take", fps=5.0, start_seconds=2.0),
        frame_rate=5.0,
        labels=np.repeat([0, 1, 0], [2, 5, 3]),
        energy=np.array([np.nan, *np.linspace(0, 1, 8), np.nan]),
        key_frames=np.array([1, 5]),
        confidence=np.array([0.5, 0.25]),
    )


def test_segments_are_half_open_and_tile_the_take(result):
    """Each begins where the one before it ends."""
    assert [(s.start, s.end, s.motion, s.name) for s in result.segments] == [
        (0, 2, 0, "A"), (2, 7, 1, "B"), (7, 10, 0, "A")
    ]  # fmt: skip
    assert result.cuts.tolist() == [2, 7]
    assert result.motions == 2


def test_seconds_are_on_the_files_clock_and_end_with_the_last_key(result):
    """The last segment ends at the last frame's time, not one frame later."""
    assert [(s.start_seconds, s.end_seconds) for s in result.segments] == [(2.0, 2.4), (2.4, 3.4), (3.4, 3.8)]
    assert result.document().duration_seconds == 1.8


def test_a_cut_is_as_sure_as_the_method_says(result):
    """The end of the take is certain."""
    assert [s.confidence for s in result.segments] == [0.5, 0.25, 1.0]


def test_the_document_is_json_with_null_where_the_energy_is_undefined(result):
    """And key-frames carry time, energy and motion."""
    said = json.loads(result.to_json("some-id"))
    assert said["id"] == "some-id"
    assert said["energy"][0] is None
    assert said["energy"][1] == 0
    assert said["key_frames"][1] == {"frame": 5, "seconds": 3.0, "energy": pytest.approx(4 / 7), "motion": 1}


def test_labels_are_numbered_as_they_appear():
    """Whatever a method called its clusters."""
    assert number_by_appearance(np.array([7, 7, -2, 7, 3])).tolist() == [0, 0, 1, 0, 2]


def test_motions_that_nobody_named_are_called_by_letters():
    """A to Z, then AA."""
    assert [motion_name(i) for i in (0, 1, 25, 26, 27, 701, 702)] == ["A", "B", "Z", "AA", "AB", "ZZ", "AAA"]
