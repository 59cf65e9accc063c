"""An upload becomes a result, through a real queue and real workers."""

import json

import numpy as np

from caesura.worker.queue.auxiliary_jobs import submit_export
from tests.installation import SLOWLY


def test_an_upload_becomes_a_result(place, take):
    """A submitted take is queued, runs, and is done; record, document, curve and labels tell the same."""
    animation = place.upload(take)
    submitted = place.submit(animation, motions=2)
    assert submitted.status == "queued"
    assert submitted.queue == "analyse"
    done = place.ended(submitted.id)
    assert (done.status, done.problem, done.attempt) == ("done", None, 1)
    document, energy, labels = place.records.segmentations.result(done.id)
    told = json.loads(document)
    assert told["id"] == done.id
    assert told["frames"] == done.frames == len(np.frombuffer(labels, "<u2")) == len(np.frombuffer(energy, "<f4"))
    assert told["motions"] == done.motions
    assert [segment["start"] for segment in told["segments"]] == [segment.start for segment in done.segments]


def test_the_page_has_something_to_play(place, take):
    """The model and its strain are blobs that the record points to."""
    done = place.ended(place.submit(place.upload(take)).id)
    viewer = done.analysis.viewer
    assert viewer.document["kind"] == "vertices"
    assert place.blobs.size(viewer.model) > 0
    assert place.blobs.size(viewer.strain) > 0


def test_progress_names_the_stages_in_order(place, long_take):
    """While it runs, the record says where: fractions of one stage never fall, and the last word is the whole."""
    submitted = place.submit(place.upload(long_take), **SLOWLY)
    told = []

    def note(record):
        if record.status == "running" and record.stage and (not told or told[-1] != (record.stage, record.fraction)):
            told.append((record.stage, record.fraction))
        return not record.live

    done = place.until(submitted.id, note)
    assert done.status == "done", done.problem
    assert (done.stage, done.fraction) == ("", 1.0)
    assert len({stage for stage, _ in told}) > 2
    for stage in {stage for stage, _ in told}:
        fractions = [fraction for name, fraction in told if name == stage]
        assert fractions == sorted(fractions)


def test_a_second_cut_touches_no_vertices(place, take):
    """Another K of an analysed take is a job of the queue `cut`, and works although the upload is gone."""
    animation = place.upload(take)
    place.ended(place.submit(animation, motions=1).id)
    place.blobs.delete(animation.parts[0].key)
    second = place.submit(animation, motions=2)
    assert second.queue == "cut"
    assert place.ended(second.id).status == "done"


def test_a_lost_analysis_is_made_again(place, take):
    """A `cut` that finds no analysis in the store sends the take back to `analyse`."""
    animation = place.upload(take)
    first = place.ended(place.submit(animation, motions=1).id)
    place.blobs.delete(first.analysis.key)
    second = place.submit(animation, motions=2)
    assert second.queue == "cut"
    done = place.ended(second.id)
    assert (done.status, done.queue, done.attempt) == ("done", "analyse", 1)


def test_a_bad_file_is_told_once(place):
    """What is no animation fails at the first attempt with its problem, and is not tried again when posted again."""
    animation = place.upload(b"<html>not found</html>")
    failed = place.ended(place.submit(animation).id)
    assert (failed.status, failed.attempt) == ("failed", 1)
    assert failed.problem["code"] == "unsupported-media-type"
    assert place.submit(animation) == failed


def test_a_file_that_is_gone_is_told_and_may_come_back(place, take):
    """Without its blob an animation cannot be analysed; posted again, it is tried again."""
    animation = place.upload(take)
    place.blobs.delete(animation.parts[0].key)
    failed = place.ended(place.submit(animation).id)
    assert (failed.status, failed.problem["code"]) == ("failed", "animation-deleted")
    assert place.submit(animation).status == "queued"


def test_an_npz_is_made_of_a_result(place, take):
    """The web process has no arrays, so a job writes the NPZ; asked for twice, it is made once."""
    done = place.ended(place.submit(place.upload(take)).id)
    assert submit_export(place.jobs, done.id, "npz").key is None
    while (made := place.records.exports.one(done.id, "npz")).key is None:
        assert made.problem is None
    assert submit_export(place.jobs, done.id, "npz") == made
    with place.blobs.path(made.key) as path, np.load(path) as arrays:
        assert len(arrays["energy"]) == len(arrays["labels"]) == done.frames
        assert arrays["segments"][-1, 1] == done.frames
