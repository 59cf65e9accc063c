"""Uploaded animations can be listed, read back by Range, and deleted with everything made of them."""

import pytest

from caesura.worker.records import Records
from caesura.worker.records.connection import connect
from tests.glb import moving_square


@pytest.fixture(scope="module")
def content(take):
    return take(201)


@pytest.fixture(scope="module")
def animation(service, content):
    return service.http.post("/v1/animations", params={"name": "bar.npz"}, content=content).json()


def test_an_animation_is_found_again(service, animation):
    """Its own address answers what the upload answered."""
    assert service.http.get(f"/v1/animations/{animation['id']}").json() == animation


def test_an_unknown_animation_is_not_found(service):
    """404, as a problem document, also for its file and for deleting it."""
    for method, path in (("GET", ""), ("GET", "/file"), ("DELETE", "")):
        answer = service.http.request(method, f"/v1/animations/nothing{path}")
        assert answer.status_code == 404
        assert answer.json()["code"] == "not-found"


def test_animations_are_listed_by_pages_newest_first(service, take):
    """Following `next` visits every animation once."""
    ids = [service.http.post("/v1/animations", content=take(seed)).json()["id"] for seed in (202, 203, 204)]
    page = service.http.get("/v1/animations", params={"limit": 2}).json()
    listed = [one["id"] for one in page["animations"]]
    assert listed == ids[:0:-1]
    while page["next"]:
        page = service.http.get(page["next"]).json()
        listed += [one["id"] for one in page["animations"]]
    assert set(ids) <= set(listed)
    assert len(set(listed)) == len(listed)


def test_a_list_has_no_takes(service):
    """A file may have hundreds, each with a long name: a list says how many, the animation's own address which."""
    model = moving_square()
    (one,) = model.json["animations"]
    model.json["animations"] = [{**one, "name": f"take {number} ".ljust(100, "x")} for number in range(900)]
    made = service.http.post("/v1/animations", content=model.glb()).json()
    answer = service.http.get("/v1/animations", params={"limit": 1})
    assert len(answer.content) < 1000
    assert answer.json()["animations"] == [{name: value for name, value in made.items() if name != "takes"}]
    assert (made["take_count"], made["duration_seconds"]) == (900, pytest.approx(1))
    own = service.http.get(f"/v1/animations/{made['id']}").json()
    assert own == made
    assert len(own["takes"]) == 900


def test_an_animation_is_called_otherwise_and_found_by_any_part_of_its_name(service, take):
    """Its results are called so too, but for those that were named apart; the same bytes again bring their new name."""
    content = take(208)
    made = service.http.post("/v1/animations", params={"name": "first.npz"}, content=content).json()
    address = f"/v1/animations/{made['id']}"
    ask = {"headers": {"Prefer": "wait=30"}}
    one = service.http.post("/v1/segmentations", json={"animation": made["id"]}, **ask).json()
    other = service.http.post("/v1/segmentations", json={"animation": made["id"], "name": "mine", "motions": 2}, **ask)
    assert service.http.patch(address, json={"name": "a/Grand Entrance.npz"}).json()["name"] == "Grand Entrance.npz"
    names = [service.http.get(f"/v1/segmentations/{i}").json()["name"] for i in (one["id"], other.json()["id"])]
    assert names == ["Grand Entrance.npz", "mine"]
    found = service.http.get("/v1/animations", params={"search": "ENTRANCE", "limit": 1}).json()
    assert [entry["id"] for entry in found["animations"]] == [made["id"]]
    assert service.http.get(found["next"]).json() == {"animations": [], "next": None}
    for wrong in ({}, {"name": ""}, {"name": "\u200b"}, {"name": "x" * 201}):
        assert service.http.patch(address, json=wrong).status_code == 422
    again = service.http.post("/v1/animations", params={"name": "second.npz"}, content=content)
    assert (again.status_code, again.json()["name"]) == (200, "second.npz")
    assert service.http.get(f"/v1/segmentations/{one['id']}").json()["name"] == "second.npz"


def test_a_list_names_the_segmentation_that_a_person_edited_last(service, take):
    """Null before the first edit, and once that segmentation has gone."""
    ask = {"headers": {"Prefer": "wait=30"}}
    content = take(209)
    done = [service.http.post(f"/v1/segmentations?motions={k}", content=content, **ask).json() for k in (2, 3)]
    address = f"/v1/animations/{done[0]['animation']}"
    assert service.http.get(address).json()["edited"] is None
    for status in done:
        segments = [{key: one[key] for key in ("start", "end", "motion")} for one in status["segments"]]
        saved = service.http.post(
            f"/v1/segmentations/{status['id']}/revisions", json={"segments": segments}, headers={"If-Match": '"0"'}
        )
        assert saved.status_code == 201
        assert service.http.get(address).json()["edited"] == status["id"]
    listed = service.http.get("/v1/animations", params={"limit": 5}).json()["animations"]
    assert {one["id"]: one["edited"] for one in listed}[done[0]["animation"]] == done[1]["id"]
    known = service.http.get("/v1/segmentations", params={"animation": done[0]["animation"]}).json()["segmentations"]
    assert [(one["parameters"]["motions"], one["revision"]) for one in known if one["revision"]] == [(3, 1), (2, 1)]
    service.http.delete(f"/v1/segmentations/{done[1]['id']}")
    assert service.http.get(address).json()["edited"] == done[0]["id"]


@pytest.mark.parametrize("cursor", ["!", "bmFu", "aW5m"], ids=["no base64", "nan", "inf"])
def test_a_cursor_that_no_page_gave_is_refused(service, cursor):
    """422, naming the parameter."""
    answer = service.http.get("/v1/animations", params={"cursor": cursor})
    assert answer.status_code == 422
    assert answer.json()["parameter"] == "cursor"


def test_the_file_comes_back_as_it_went_in(service, animation, content):
    """The same bytes, with an ETag that spares sending them again."""
    answer = service.http.get(f"/v1/animations/{animation['id']}/file")
    assert answer.content == content
    assert answer.headers["Accept-Ranges"] == "bytes"
    assert "bar.npz" in answer.headers["Content-Disposition"]
    again = service.http.get(answer.request.url, headers={"If-None-Match": answer.headers["ETag"]})
    assert again.status_code == 304
    assert again.content == b""


@pytest.mark.parametrize(("header", "part"), [("bytes=0-9", slice(0, 10)), ("bytes=100-", slice(100, None))])
def test_a_range_of_the_file_is_sent_alone(service, animation, content, header, part):
    """206 with Content-Range; a player seeks so."""
    answer = service.http.get(f"/v1/animations/{animation['id']}/file", headers={"Range": header})
    start, end, _ = part.indices(len(content))
    assert answer.status_code == 206
    assert answer.content == content[part]
    assert answer.headers["Content-Range"] == f"bytes {start}-{end - 1}/{len(content)}"


def test_a_range_beyond_the_file_is_refused(service, animation):
    """416."""
    answer = service.http.get(f"/v1/animations/{animation['id']}/file", headers={"Range": "bytes=999999999-"})
    assert answer.status_code == 416
    assert answer.json()["code"] == "range-not-satisfiable"


def test_deleting_an_animation_deletes_all_that_was_made_of_it(service, take):
    """Its segmentations and its blobs are gone; the same file again is a new upload."""
    content = take(205)
    status = service.http.post("/v1/segmentations", content=content, headers={"Prefer": "wait=30"}).json()
    assert status["status"] == "done"
    service.http.get(f"/v1/segmentations/{status['id']}/result.npz")
    kept = _blobs(service)
    assert service.http.delete(f"/v1/animations/{status['animation']}").status_code == 204
    assert kept - _blobs(service) >= 3  # the upload, its analysis and the export, at least
    for path in (f"animations/{status['animation']}", f"segmentations/{status['id']}"):
        assert service.http.get(f"/v1/{path}").status_code == 404
    assert service.http.post("/v1/animations", content=content).status_code == 201


def _blobs(service):
    return sum(path.is_file() for path in (service.data / "blobs").rglob("*"))


def test_an_upload_that_is_no_longer_kept_is_gone_until_it_comes_again(idle, take):
    """Its file and new cuts answer 410; its record stays, and the same bytes bring it back."""
    content = take(206)
    identifier = idle.http.post("/v1/animations", content=content).json()["id"]
    records = Records(connect(idle.redis_url))
    records.animations.strip(records.animations.one(identifier))
    assert idle.http.get(f"/v1/animations/{identifier}").status_code == 200
    assert idle.http.get(f"/v1/animations/{identifier}/file").json()["code"] == "gone"
    assert idle.http.post("/v1/segmentations", json={"animation": identifier}).status_code == 410
    assert idle.http.post("/v1/animations", content=content).json()["id"] == identifier
    assert idle.http.get(f"/v1/animations/{identifier}/file").content == content


def test_a_file_that_the_store_has_lost_is_stored_again(service, take):
    """410 until the same bytes come again; a file that was made of a result is made again."""
    content = take(207)
    status = service.http.post("/v1/segmentations", content=content, headers={"Prefer": "wait=30"}).json()
    file, made = f"/v1/animations/{status['animation']}/file", f"{status['links']['self']}/result.npz"
    assert service.http.get(made, headers={"Prefer": "wait=30"}).status_code == 200
    records = Records(connect(service.redis_url))
    lost = [records.animations.one(status["animation"]).parts[0].key, records.exports.one(status["id"], "npz").key]
    for key in lost:
        (service.data / "blobs" / key).unlink()
    assert service.http.get(file).status_code == 410
    assert service.http.get(made).status_code in {200, 202}
    assert service.http.get(made, headers={"Prefer": "wait=30"}).status_code == 200
    assert service.http.post("/v1/animations", content=content).status_code == 201
    assert service.http.get(file).content == content
