"""People edit a result: each edit is a revision on top of what was computed, which is never lost."""

import csv
import io
import itertools
import json
import struct
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import redis_keys
from caesura.worker.records.connection import connect
from caesura.worker.records.revisions import MOST_REVISIONS
from caesura.worker.result_file_writers import MOST_EXPORTS
from caesura.worker.retention.sweep import sweep
from caesura.worker.store.blobs import Blobs
from tests.glb import bending_strip

FRAMES = 240


def cut(service, content, motions=3):
    """The address of a finished segmentation."""
    query = f"/v1/segmentations?motions={motions}&name=take"
    answer = service.http.post(query, content=content, headers={"Prefer": "wait=30"})
    assert answer.status_code == 200, answer.text
    return answer.headers["Location"]


@pytest.fixture(scope="module")
def address(service, take):
    return cut(service, take(611))


@pytest.fixture
def fresh(service, take, request):
    """A result that nobody has edited yet."""
    here = cut(service, take(sum(map(ord, request.node.name)) + 5000))
    yield here
    service.http.delete(here)


def revise(service, here, segments, match='"0"', **more):
    headers = {} if match is None else {"If-Match": match}
    return service.http.post(f"{here}/revisions", json={"segments": segments, **more}, headers=headers)


def edit(start, end, motion=0, **more):
    return {"start": start, "end": end, "motion": motion, **more}


WALK = [edit(0, 100, 7, name="walk", loop=True), edit(100, 150, 3), edit(150, FRAMES, 7, discard=True)]


def test_an_edit_is_a_revision_and_the_computed_result_stays(service, fresh):
    """Posted, listed, read again; every form of the result reads with it where it is asked for, and only there."""
    computed = service.http.get(f"{fresh}/result").json()
    made = revise(service, fresh, WALK, note="the middle is one motion")
    assert (made.status_code, made.headers["ETag"]) == (201, '"1"')
    assert made.headers["Location"] == f"{fresh}/revisions/1"
    document = made.json()
    assert [(s["motion"], s["name"], s["loop"], s["discard"]) for s in document["segments"]] == [
        (0, "walk", True, False), (1, "A", False, False), (0, "walk", False, True),
    ]  # fmt: skip
    assert service.http.get(made.headers["Location"]).json() == document
    assert service.http.get(f"{fresh}/revisions/latest").json() == document
    listed = service.http.get(f"{fresh}/revisions")
    assert [(r["revision"], r["note"]) for r in listed.json()["revisions"]] == [
        (0, ""), (1, "the middle is one motion"),
    ]  # fmt: skip
    assert listed.headers["ETag"] == '"1"'
    status = service.http.get(fresh).json()
    assert (status["revision"], status["links"]["revisions"]) == (1, f"{fresh}/revisions")
    for query in ("", "?revision=0"):
        assert service.http.get(f"{fresh}/result{query}").json() == computed
    assert service.http.get(f"{fresh}/revisions/0").json()["segments"] == computed["segments"]


def test_the_result_reads_with_a_revision(service, fresh):
    """JSON, CSV, VTT and NPZ, with times, motions of key-frames and confidences as they are now."""
    computed = service.http.get(f"{fresh}/result").json()
    kept = computed["segments"][0]
    segments = [edit(0, kept["end"], 0, name="x"), edit(kept["end"], 231, 1, name="y"), edit(231, FRAMES, 0)]
    assert revise(service, fresh, segments).status_code == 201
    read = service.http.get(f"{fresh}/result?revision=latest").json()
    assert read["revision"] == 1
    assert read["motions"] == 2
    assert [s["confidence"] for s in read["segments"]] == [kept["confidence"], None, 1.0]
    assert [s["start_seconds"] for s in read["segments"]] == pytest.approx([0, kept["end_seconds"], 7.7])
    assert read["segments"][-1]["end_seconds"] == computed["segments"][-1]["end_seconds"]
    inside = [s["motion"] for k in read["key_frames"] for s in read["segments"] if s["start"] <= k["frame"] < s["end"]]
    assert [k["motion"] for k in read["key_frames"]] == inside
    assert read["energy"] == computed["energy"]
    table = service.http.get(f"{fresh}/result.csv?revision=1")
    assert [(row["name"], row["start"]) for row in csv.DictReader(io.StringIO(table.text))] == [
        ("x", "0"), ("y", str(kept["end"])), ("x", "231"),
    ]  # fmt: skip
    assert service.http.get(f"{fresh}/result.vtt?revision=1").text.count(" --> ") == 3
    arrays = service.http.get(f"{fresh}/result.npz?revision=1", headers={"Prefer": "wait=20"})
    with np.load(io.BytesIO(arrays.content), allow_pickle=False) as found:
        assert found["labels"].tolist() == [0] * kept["end"] + [1] * (231 - kept["end"]) + [0] * 9
        assert json.loads(bytes(found["document"]))["revision"] == 1


def test_every_revision_has_a_tag_of_its_own(service, fresh):
    """304 to who has it; the computed result's tag outlives an edit."""
    before = service.http.get(f"{fresh}/result").headers["ETag"]
    revise(service, fresh, WALK)
    first = service.http.get(f"{fresh}/result?revision=1").headers["ETag"]
    assert first != before
    for path, tag in (("result", before), ("result?revision=1", first), ("revisions/1", '"1"')):
        again = service.http.get(f"{fresh}/{path}", headers={"If-None-Match": tag})
        assert (again.status_code, again.content) == (304, b""), path
    assert service.http.get(f"{fresh}/result?revision=latest", headers={"If-None-Match": before}).status_code == 200


def test_of_two_editors_one_is_told(service, fresh):
    """Both saw the computed result and save in the same moment: one revision is kept, the other hears its number."""
    other = [edit(0, FRAMES, 0, name="all")]
    with ThreadPoolExecutor(8) as editors:
        answers = list(editors.map(lambda number: revise(service, fresh, (WALK, other)[number % 2]), range(8)))
    assert sorted(answer.status_code for answer in answers) == [201, *[412] * 7]
    refused = next(answer.json() for answer in answers if answer.status_code == 412)
    assert (refused["code"], refused["current"]) == ("stale-revision", 1)
    assert len(service.http.get(f"{fresh}/revisions").json()["revisions"]) == 2
    again = revise(service, fresh, other, match='"1"')
    assert (again.status_code, again.json()["revision"]) == (201, 2)
    assert service.http.get(f"{fresh}/revisions/1").status_code == 200
    assert revise(service, fresh, WALK, match="*").json()["revision"] == 3


@pytest.mark.parametrize(("match", "status"), [(None, 428), ('"7"', 412), ("0", 412), ('W/"0"', 412)])
def test_it_must_say_what_was_edited(service, address, match, status):
    """Without If-Match 428; with a tag that is not the newest revision's, 412."""
    answer = revise(service, address, WALK, match=match)
    assert answer.status_code == status
    assert "detail" in answer.json()
    assert service.http.get(address).json()["revision"] == 0


WHOLE = edit(0, FRAMES)
BAD = {
    "nothing": ([], "/segments"),
    "an overlap": ([edit(0, 100), edit(99, FRAMES)], "/segments/1/start"),
    "a gap": ([edit(0, 100), edit(101, FRAMES)], "/segments/1/start"),
    "a late beginning": ([edit(1, FRAMES)], "/segments/0/start"),
    "a segment without frames": ([edit(0, 100), edit(100, 100), edit(100, FRAMES)], "/segments/1/end"),
    "past the end": ([edit(0, FRAMES + 1)], "/segments/0/end"),
    "short of the end": ([edit(0, 100), edit(100, 239)], "/segments/1/end"),
    "two names for a motion": ([edit(0, 9, name="a"), edit(9, FRAMES, name="b")], "/segments/1/name"),
    "two motions of a name": ([edit(0, 9, name="a"), edit(9, FRAMES, 1, name="a")], "/segments/1/name"),
    "an empty name": ([edit(0, FRAMES, name="")], "/segments/0/name"),
    "a blank name": ([edit(0, FRAMES, name="  ")], "/segments/0/name"),
    "a long name": ([edit(0, FRAMES, name="n" * 101)], "/segments/0/name"),
    "a line break": ([edit(0, FRAMES, name="a\nb")], "/segments/0/name"),
    "a control character": ([edit(0, FRAMES, name="a\x00b")], "/segments/0/name"),
    "text turned round": ([edit(0, FRAMES, name="a\u202eb")], "/segments/0/name"),
    "nothing to see": ([edit(0, FRAMES, name="\u200d")], "/segments/0/name"),
    "a wide formula": ([edit(0, FRAMES, name="＝1+1")], "/segments/0/name"),
    "a formula": ([edit(0, FRAMES, name="=1+1")], "/segments/0/name"),
    "a key that is not known": ([{**WHOLE, "colour": 1}], "/segments/0/colour"),
    "a key left out": ([{"start": 0, "end": FRAMES}], "/segments/0/motion"),
    "a number as text": ([edit("0", FRAMES)], "/segments/0/start"),
    "half a frame": ([edit(0, 239.5)], "/segments/0/end"),
    "a truth for a number": ([edit(False, FRAMES)], "/segments/0/start"),
    "an endless number": ([edit(0, 10**400)], "/segments/0/end"),
    "a loop that is no truth": ([edit(0, FRAMES, loop="yes")], "/segments/0/loop"),
    "no list": ({"0": WHOLE}, "/segments"),
}


@pytest.mark.parametrize("what", BAD)
def test_segments_that_do_not_fit_are_refused_where_they_do_not(service, address, what):
    """422, with a sentence and a pointer into the JSON; nothing is kept."""
    segments, pointer = BAD[what]
    answer = revise(service, address, segments)
    assert (answer.status_code, answer.json()["pointer"]) == (422, pointer), answer.text
    assert answer.json()["detail"].endswith(".")
    assert service.http.get(address).json()["revision"] == 0


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        (b"{", 400, "malformed-json"),
        (b"[]", 400, "malformed-json"),
        (b'{"segments": [], "note": "\\ud800"}', 400, "malformed-json"),
        (b'{"note": ""}', 422, "invalid-parameter"),
        (b'{"segments": [{"start":0,"end":240,"motion":0}], "note": "a\\nb"}', 422, "invalid-parameter"),
        (b'{"segments": [{"start":0,"end":240,"motion":0}], "author": "me"}', 422, "invalid-parameter"),
        (b'{"segments": [' + b'{"start":0,"end":1,"motion":0},' * 9000 + b"{}]}", 400, "json-too-long"),
        (b"[" * 200_000, 400, "malformed-json"),
    ],
)
def test_a_body_that_is_none_is_refused(service, address, body, status, code):
    """Read no further than a quarter of a mebibyte, and never a 500."""
    answer = service.http.post(f"{address}/revisions", content=body, headers={"If-Match": '"0"'})
    assert (answer.status_code, answer.json()["code"]) == (status, code)


@pytest.mark.parametrize("path", ["revisions/1", "result?revision=1", "result.npz?revision=9", "clips?revision=1"])
def test_a_revision_that_there_is_not_is_said(service, address, path):
    """404, with the number of the newest."""
    answer = service.http.get(f"{address}/{path}")
    assert (answer.status_code, answer.json()["code"]) == (404, "not-found")
    assert "newest is 0" in answer.json()["detail"]


@pytest.mark.parametrize("path", ["revisions/newest", "result?revision=-1", "keyframes?revision=1.5"])
def test_a_revision_is_a_number_or_the_latest(service, address, path):
    """422 for anything else."""
    assert service.http.get(f"{address}/{path}").json()["code"] == "invalid-parameter"


def test_what_is_not_finished_cannot_be_edited(idle, take):
    """409, as for its result."""
    here = idle.http.post("/v1/segmentations?motions=3", content=take(612)).headers["Location"]
    assert revise(idle, here, WALK).json()["code"] == "not-finished"
    assert idle.http.get(f"{here}/revisions").status_code == 409


def kept_in_redis(service, here):
    redis = connect(service.redis_url)
    identifier = here.rpartition("/")[2]
    return [
        name
        for name in (redis_keys.revisions_key(identifier), redis_keys.revised_key(identifier))
        if redis.exists(name)
    ]


def test_revisions_go_with_their_result(service, take):
    """Deleted by a person or when its time has run out: nothing of them is left, and the same cut begins anew at 0."""
    here = cut(service, take(613))
    revise(service, here, WALK)
    assert len(kept_in_redis(service, here)) == 2
    assert service.http.delete(here).status_code == 204
    assert kept_in_redis(service, here) == []
    assert cut(service, take(613)) == here
    assert [r["revision"] for r in service.http.get(f"{here}/revisions").json()["revisions"]] == [0]
    revise(service, here, WALK)
    jobs, blobs = Jobs(connect(service.redis_url)), Blobs.open(str(service.data / "blobs"), service.data / "scratch")
    identifier = here.rpartition("/")[2]
    jobs.records.segmentations.change(identifier, lambda record: record)
    key = redis_keys.segmentation_key(identifier)
    record = json.loads(jobs.redis.get(key))
    jobs.redis.set(key, json.dumps({**record, "updated": 0}))
    sweep(jobs, blobs, 1e9, 1e9)
    assert service.http.get(here).status_code == 404
    assert kept_in_redis(service, here) == []


def test_there_is_an_end_to_revisions(service, fresh):
    """After a thousand of one result no more are kept, and that is said."""
    identifier, records = fresh.rpartition("/")[2], Jobs(connect(service.redis_url)).records
    records.segmentations.change(identifier, lambda record: record.with_changes(revision=MOST_REVISIONS))
    answer = revise(service, fresh, WALK, match=f'"{MOST_REVISIONS}"')
    assert (answer.status_code, answer.json()["code"]) == (409, "too-many-revisions")


def clip_names(glb):
    size = struct.unpack_from("<I", glb, 12)[0]
    return [animation["name"] for animation in json.loads(glb[20 : 20 + size])["animations"]]


def test_clips_carry_what_a_person_has_set(service):
    """Names, loops, and what is discarded left out unless it is asked for; the computed clips stay as they were."""
    model = bending_strip()
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    model.json["asset"]["extras"] = {"of": "revisions"}
    times = np.arange(241) / 30
    nod = 0.6 * np.sin(6 * times) * (times < 4)
    model.animate(2, "rotation", times, np.stack([0 * times, 0 * times, np.sin(nod), np.cos(nod)], 1))
    here = cut(service, model.glb(), motions=1)
    frames = service.http.get(here).json()["frames"]
    segments = [edit(0, 120, 0, name="T-pose", discard=True), edit(120, 180, 1, name="go left/right", loop=True)]
    assert revise(service, here, [*segments, edit(180, frames, 1)]).status_code == 201

    def fetched(path):
        answer = service.http.get(f"{here}/{path}", headers={"Prefer": "wait=30"})
        assert answer.status_code == 200, answer.text
        return answer.content

    assert clip_names(fetched("clips")) == ["A_01"]
    assert clip_names(fetched("clips?revision=latest")) == ["go_left_right_01-loop", "go_left_right_02"]
    assert clip_names(fetched("clips?revision=1&keep_discarded=true"))[0] == "T-pose_01"
    assert clip_names(fetched("keyframes?revision=1")) == ["key_frames"]


def test_only_the_newest_files_are_kept(service, fresh):
    """Who asks for more and more of them fills no disk: the oldest go, and are made again where they are asked for."""
    identifier, jobs = fresh.rpartition("/")[2], Jobs(connect(service.redis_url))
    for seconds in range(MOST_EXPORTS + 2):
        answer = service.http.get(f"{fresh}/clips?min_seconds=0.0{seconds:02}", headers={"Prefer": "wait=30"})
        assert answer.status_code == 200
    while len(kept := jobs.records.exports.forms(identifier)) > MOST_EXPORTS:
        time.sleep(0.05)  # the worker clears up after its answer
    assert "clips?min_seconds=0.001" not in kept
    stored = {path.name for path in (service.data / "blobs" / "exports").rglob("*")}
    assert {jobs.records.exports.one(identifier, form).key.rpartition("/")[2] for form in kept} <= stored
    assert service.http.get(f"{fresh}/clips", headers={"Prefer": "wait=30"}).status_code == 200


def test_answers_that_there_is_no_file_are_as_few(service, fresh):
    """Each wish for clips of a motion that there is not is refused, and no more of them are remembered than files."""
    identifier, records = fresh.rpartition("/")[2], Jobs(connect(service.redis_url)).records
    for number in range(MOST_EXPORTS + 3):
        answer = service.http.get(f"{fresh}/clips?loop=none-{number}", headers={"Prefer": "wait=30"})
        assert (answer.status_code, answer.json()["code"]) == (422, "unknown-motion")
    while len(records.exports.forms(identifier)) > MOST_EXPORTS:
        time.sleep(0.05)
    assert len(list(records.redis.scan_iter(f"caesura:export:{identifier}:*", count=1000))) <= MOST_EXPORTS


def test_the_loop_of_a_segment_that_was_cut_otherwise_is_searched_within_it(service, fresh):
    """Where the client waits for it; the computed loop lies half outside by now, and is offered no more."""
    computed = service.http.get(f"{fresh}/result").json()["segments"]
    at, whole = max(
        enumerate(computed[:-1]), key=lambda found: (found[1]["best_loop"] or {"end": 0, "start": 0})["end"]
    )
    old = whole["best_loop"]
    start = (old["start"] + old["end"]) // 2
    bounds = [*(one["start"] for one in computed), FRAMES]
    bounds.insert(at + 1, start)
    segments = [edit(*pair, motion) for motion, pair in enumerate(itertools.pairwise(bounds))]
    hasty = revise(service, fresh, segments).json()["segments"]
    assert hasty[at + 1]["best_loop"] is None
    headers = {"If-Match": '"1"', "Prefer": "wait=30"}
    kept = service.http.post(f"{fresh}/revisions", json={"segments": segments}, headers=headers)
    assert kept.headers["Preference-Applied"] == "wait=30"
    found = kept.json()["segments"]
    loop = found[at + 1]["best_loop"]
    assert found[at + 1]["start"] <= loop["start"] < loop["end"] <= found[at + 1]["end"]
    assert [one["best_loop"] for one in found[at + 2 :]] == [one["best_loop"] for one in computed[at + 1 :]]
    assert service.http.get(f"{fresh}/revisions/2").json()["segments"] == found
    assert service.http.get(f"{fresh}/revisions/1").json()["segments"] == hasty
