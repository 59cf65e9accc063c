"""Several segmentations in one request: each has the answer that it would have alone, and none stops another."""

import json

import pytest


def test_each_item_of_the_json_has_its_answer(idle, take):
    """In order: the ids are those that single requests give; what is refused says why, and the rest is queued."""
    animations = [idle.http.post("/v1/animations", content=take(9300 + seed)).json()["id"] for seed in range(3)]
    items = [
        {"animation": animations[0], "motions": 3}, {"animation": "nothing"}, {"animation": animations[1], "bins": 1},
        "no object", {"animation": animations[2], "callback_url": "http://127.0.0.1/"}, {"motions": 3},
        {"url": "http://example.com/x.glb"}, {"animation": animations[1]}, {"animation": animations[1]},
    ]  # fmt: skip
    answer = idle.http.post("/v1/batches", json={"segmentations": items})
    assert answer.status_code == 200
    answers = answer.json()["answers"]
    assert [one["status"] for one in answers] == [202, 404, 422, 422, 422, 422, 422, 202, 202]
    codes = [(one["problem"] or {}).get("code") for one in answers]
    missing = "missing-parameter"
    assert codes[:7] == [None, "not-found", "invalid-parameter", missing, "forbidden-address", missing, missing]
    assert all((one["segmentation"] is None) == (one["problem"] is not None) for one in answers)
    assert answers[7]["segmentation"]["id"] == answers[8]["segmentation"]["id"]
    alone = idle.http.post("/v1/segmentations", json=items[0]).json()
    assert alone["id"] == answers[0]["segmentation"]["id"]


def test_each_file_of_a_form_is_an_animation(idle, take):
    """Under its own name, with the parameters of the form and the query; a file that cannot be read stops no other."""
    names = ["one.npz", "broken.npz", "two.npz"]
    contents = [take(9310), b"no animation", take(9311)]
    files = [("file", (name, content)) for name, content in zip(names, contents, strict=True)]
    answer = idle.http.post("/v1/batches?motions=3", data={"trim": "true"}, files=files)
    answers = answer.json()["answers"]
    assert [one["status"] for one in answers] == [202, 415, 202]
    made = [one["segmentation"] for one in answers if one["segmentation"]]
    assert [one["name"] for one in made] == ["one.npz", "two.npz"]
    assert all((one["parameters"]["motions"], one["parameters"]["trim"]) == (3, True) for one in made)
    assert not idle.spooled()


@pytest.mark.parametrize(
    "body",
    [{}, {"segmentations": []}, {"segmentations": {}}, {"segmentations": [{}] * 101}, {"segmentations": [1], "x": 1}],
)
def test_what_is_no_batch_is_refused(idle, body):
    """With the place that is wrong."""
    answer = idle.http.post("/v1/batches", content=json.dumps(body), headers={"Content-Type": "application/json"})
    assert (answer.status_code, answer.json()["pointer"]) == (422, "/segmentations")
