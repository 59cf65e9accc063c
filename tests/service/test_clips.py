"""The file comes back with its motions as clips: made by a worker at the first request, then served as stored."""

import io
import json
import struct
import zipfile

import numpy as np
import pytest

from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import redis_keys
from caesura.worker.records.connection import connect
from caesura.worker.retention.sweep import sweep
from caesura.worker.store.blobs import Blobs
from tests.glb import strip_of_two_motions


def moves(seed):
    """A strip that nods, and then widens, for four seconds each; other for every seed."""
    model = strip_of_two_motions()
    model.json["asset"]["extras"] = {"seed": seed}
    return model.glb()


@pytest.fixture(scope="module")
def address(service):
    answer = service.http.post(
        "/v1/segmentations?motions=2&name=strip.glb", content=moves(1), headers={"Prefer": "wait=30"}
    )
    assert answer.status_code == 200, answer.text
    return answer.headers["Location"]


def names(glb):
    size = struct.unpack_from("<I", glb, 12)[0]
    return [animation["name"] for animation in json.loads(glb[20 : 20 + size])["animations"]]


def fetched(service, path):
    answer = service.http.get(path, headers={"Prefer": "wait=30"})
    assert answer.status_code == 200, answer.text
    return answer


def test_the_file_comes_back_in_clips(service, address):
    """One named animation for each segment, to be saved under the name it came with; by Range and by tag."""
    segments = service.http.get(f"{address}/result").json()["segments"]
    answer = fetched(service, f"{address}/clips")
    assert answer.headers["Content-Type"] == "model/gltf-binary"
    assert "strip-clips.glb" in answer.headers["Content-Disposition"]
    assert [name.partition("_")[0] for name in names(answer.content)] == [segment["name"] for segment in segments]
    again = service.http.get(f"{address}/clips", headers={"If-None-Match": answer.headers["ETag"]})
    assert again.status_code == 304
    part = service.http.get(f"{address}/clips", headers={"Range": "bytes=0-3"})
    assert (part.status_code, part.content) == (206, b"glTF")


def test_every_choice_is_a_file_of_its_own(service, address):
    """The take kept beside its clips; clips as files of their own; key poses."""
    assert "take" in names(fetched(service, f"{address}/clips?keep_source=true").content)
    separate = fetched(service, f"{address}/clips?files=separate&loop=A")
    assert separate.headers["Content-Type"] == "application/zip"
    assert "strip-clips.zip" in separate.headers["Content-Disposition"]
    with zipfile.ZipFile(io.BytesIO(separate.content)) as archive:
        assert "A_01-loop.glb" in archive.namelist()
    assert names(fetched(service, f"{address}/keyframes").content) == ["key_frames"]


@pytest.mark.parametrize("query", ["", "?only=2&names=hero_{motion}", "?files=separate&handles_seconds=0.2&loop=A"])
def test_the_plan_names_the_clips_of_the_file(service, address, query):
    """The same names in the same order as the file has; nothing is written for it."""
    planned = service.http.get(f"{address}/clips/plan{query}").json()["clips"]
    content = fetched(service, f"{address}/clips{query}").content
    if "separate" in query:
        made = [name.removesuffix(".glb") for name in zipfile.ZipFile(io.BytesIO(content)).namelist()]
    else:
        made = names(content)
    assert [clip["name"] for clip in planned] == made
    assert all(clip["start_seconds"] < clip["end_seconds"] for clip in planned)


@pytest.mark.parametrize(
    ("query", "code"),
    [
        ("origin=middle", "invalid-parameter"),
        ("discard=A,B", "no-clips"),
        ("loop=Z", "unknown-motion"),
        ("loops=A", "unknown-parameter"),
        ("only=99", "invalid-parameter"),
        ("names={name}", "invalid-parameter"),
    ],
)
def test_what_is_not_possible_is_said(service, address, query, code):
    """422, naming the parameter."""
    answer = service.http.get(f"{address}/clips?{query}", headers={"Prefer": "wait=30"})
    assert (answer.status_code, answer.json()["code"]) == (422, code)
    assert answer.json()["parameter"]


def test_a_sequence_comes_back_as_a_zip_of_sequences(service, take):
    """Its frames, all of them, in the form that they were sent in."""
    made = service.http.post("/v1/segmentations?motions=3", content=take(771), headers={"Prefer": "wait=30"})
    answer = fetched(service, f"{made.headers['Location']}/clips")
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        clips = [np.load(io.BytesIO(archive.read(name))) for name in archive.namelist()]
    assert sum(len(clip["vertices"]) for clip in clips) == 240


def test_clips_go_with_the_upload(service):
    """Once its time has run out, the result stays and the clips do not: 410, and no copy of the file is left."""
    made = service.http.post("/v1/segmentations?motions=2", content=moves(2), headers={"Prefer": "wait=30"}).json()
    here = made["links"]["clips"]
    assert fetched(service, here).content.startswith(b"glTF")
    jobs, blobs = Jobs(connect(service.redis_url)), Blobs.open(str(service.data / "blobs"), service.data / "scratch")
    copy = jobs.records.exports.one(made["id"], "clips").key
    jobs.redis.zadd(redis_keys.LAST_USED_KEY, {made["animation"]: 0})
    sweep(jobs, blobs, 1e9, 1e9)
    answer = service.http.get(here)
    assert (answer.status_code, answer.json()["code"]) == (410, "gone")
    assert not (service.data / "blobs" / copy).exists()
    assert service.http.get(made["links"]["result"]).status_code == 200
