"""Labels that a person brings, in four forms, give the same truth."""

import json

import numpy as np
import pytest

from benchmarks.takes.labelled import labelled, per_frame, read_labels

TRUTH = {
    "fps": 30,
    "frames": 90,
    "segments": [
        {"label": "walk", "start": 0, "end": 20},
        {"label": "run", "start": 20, "end": 71},
        {"label": "walk", "start": 71, "end": 90},
    ],
}
RESULT = {
    "frame_rate": 30.0,
    "frames": 90,
    "segments": [{"start": s["start"], "end": s["end"], "motion": s["label"] == "run"} for s in TRUTH["segments"]],
}
CSV = "name,motion,start,end,start_seconds,end_seconds\n" + "".join(
    f"{s['label']},0,{s['start']},{s['end']},{s['start'] / 30:.6f},{s['end'] / 30:.6f}\n" for s in TRUTH["segments"]
)
SLOTS = "".join(
    f'<TIME_SLOT TIME_SLOT_ID="{side}{i}" TIME_VALUE="{round(s[key] / 30 * 1000)}"/>'
    for i, s in enumerate(TRUTH["segments"])
    for side, key in (("a", "start"), ("b", "end"))
)
NOTES = "".join(
    f'<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="n{i}" TIME_SLOT_REF1="a{i}" TIME_SLOT_REF2="b{i}">'
    f"<ANNOTATION_VALUE>{s['label']}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
    for i, s in enumerate(TRUTH["segments"])
)
EAF = (
    f"<ANNOTATION_DOCUMENT><TIME_ORDER>{SLOTS}</TIME_ORDER>"
    f'<TIER TIER_ID="empty"/><TIER TIER_ID="motions">{NOTES}</TIER></ANNOTATION_DOCUMENT>'
)
FORMS = {"take.truth.json": json.dumps(TRUTH), "take.json": json.dumps(RESULT), "take.csv": CSV, "take.eaf": EAF}


@pytest.mark.parametrize("name", FORMS)
@pytest.mark.parametrize(("rate", "frames", "cuts"), [(30.0, 90, [20, 71]), (60.0, 180, [40, 142])])
def test_every_form_gives_the_same_truth(tmp_path, name, rate, frames, cuts):
    """Cuts are at the frame, at the rate of the labels and at twice that; a label that returns is the same motion."""
    (tmp_path / "take.glb").write_bytes(b"")
    (tmp_path / name).write_text(FORMS[name])
    ((model, labels),) = labelled(tmp_path).items()
    assert model.name == "take.glb"
    truth = per_frame(read_labels(labels), frames, rate)
    assert (np.flatnonzero(np.diff(truth)) + 1).tolist() == cuts
    assert truth[0] == truth[-1] != truth[cuts[0]]


def test_what_nobody_labelled_is_a_motion_of_its_own(tmp_path):
    """A gap between two stretches."""
    (tmp_path / "take.csv").write_text("label,start_seconds,end_seconds\nwalk,0,1\nwalk,2,3\n")
    assert per_frame(read_labels(tmp_path / "take.csv"), 90, 30.0).tolist() == [0] * 30 + [1] * 30 + [0] * 30


def test_a_model_without_labels_is_left_out(tmp_path):
    """And labels without a model are."""
    (tmp_path / "alone.glb").write_bytes(b"")
    (tmp_path / "other.csv").write_text(CSV)
    assert labelled(tmp_path) == {}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("take.csv", "start,end\n1,2\n"),
        ("take.csv", "start_seconds,end_seconds\n1,2\n"),
        ("take.csv", ""),
        ("take.eaf", "<ANNOTATION_DOCUMENT/>"),
        ("take.eaf", '<!DOCTYPE a [<!ENTITY b "bomb">]><a>&b;</a>'),
    ],
)
def test_what_is_no_labelling_is_refused(tmp_path, name, text):
    """In words, and entities are never expanded."""
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match="take"):
        read_labels(tmp_path / name)
