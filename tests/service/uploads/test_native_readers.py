"""Files that a library of native code reads: through the service, and what becomes of the worker where that fails."""

import json
import math

import pytest

from tests.formats.native.fbx_text import FbxText
from tests.service.conftest import with_its_own_redis

PREFER = {"Prefer": "wait=30"}


def waving(seed: int, points: int = 4) -> bytes:
    """A board that nods for four seconds and then turns for four, as FBX; other for every seed."""
    made = FbxText()
    node = made.model("board", subtype="Mesh")
    corners = [(0, 0, seed), (10, 0, 0), (10, 10, 0), (0, 10, 0)]
    made.mesh([*corners, *[(0, 0, i) for i in range(points - 4)]], [(0, 1, 2, 3)], node)
    times = [frame / 30 for frame in range(241)]
    nod = [30 * math.sin(6 * at) * (at < 4) for at in times]
    turn = [90 * (1 - math.cos(4 * (at - 4))) * (at >= 4) for at in times]
    made.animate(made.layer(made.stack("wave", 0, 8)), node, "Lcl Rotation", times, x=nod, z=turn)
    return made.data()


def posted(service, data, name):
    return service.http.post(f"/v1/segmentations?motions=2&name={name}", content=data, headers=PREFER)


def test_an_fbx_is_segmented_and_comes_back_as_a_glb(service):
    """Its takes are listed at once; its clips are animations of a GLB."""
    answer = posted(service, waving(1), "board.fbx")
    assert answer.status_code == 200, answer.text
    address = answer.headers["Location"]
    animation = service.http.get(f"/v1/animations/{answer.json()['animation']}").json()
    assert (animation["format"], animation["takes"][0]["name"], animation["takes"][0]["frames"]) == ("fbx", "wave", 241)
    clips = service.http.get(f"{address}/clips", headers=PREFER)
    assert clips.status_code == 200, clips.text
    root = json.loads(clips.content[20 : 20 + int.from_bytes(clips.content[12:16], "little")])
    segments = service.http.get(f"{address}/result").json()["segments"]
    assert len(root["animations"]) == len(segments)
    assert root["nodes"][0]["name"] == "board"


def test_a_broken_fbx_is_a_problem_that_names_it(service):
    """The header does not tell; the reader does."""
    answer = posted(service, waving(2)[:5000], "board.fbx")
    problem = answer.json().get("problem") or answer.json()
    assert problem["code"] == "malformed-fbx", answer.text
    assert problem["file"] == "board.fbx"


@pytest.mark.timeout(120)
def test_a_reader_that_is_ended_takes_nothing_else_along(checkout, tmp_path_factory, take):
    """It needs more memory than it may have: the same worker goes on with the next file, and leaves nothing behind."""
    folder = tmp_path_factory.mktemp("readers")
    with with_its_own_redis(checkout, folder, workers=True, max_reader_bytes=2**20) as service:
        answer = posted(service, waving(3, points=60_000), "board.fbx")
        problem = answer.json().get("problem") or answer.json()
        assert (problem["code"], problem["setting"]) == ("limit-exceeded", "CAESURA_MAX_READER_BYTES"), answer.text
        assert posted(service, take(77), "bar.npz").status_code == 200
        assert not [file for file in (folder / "scratch").rglob("*") if file.is_file()]
