"""Collections: takes in the same motions, named once, corrected by people, searched by example."""

import time

import numpy as np
import pytest

from tests.animations import performing_bar
from tests.glb import square
from tests.service.conftest import npz

WAIT = {"Prefer": "wait=30"}
ORDERS = ((0, 1, 0, 1), (1, 0, 1, 0), (0, 1, 0, 1))


def performance(order, shift=0.0, rings=12):
    """A bar that performs motions, three seconds each, somewhere else each time."""
    animation = performing_bar(order, seconds=3.0, rings=rings).animation
    vertices = np.array(animation.vertices(0, animation.frames)) + np.float32([shift, 0, 0])
    return npz(vertices=vertices, triangles=animation.triangles, frame_rate=np.float64(30))


def upload(service, content):
    return service.http.post("/v1/animations", content=content).json()["id"]


def ready(service, identifier):
    """The collection once all its takes are labelled or failed."""
    deadline = time.monotonic() + 100
    while (document := service.http.get(f"/v1/collections/{identifier}", headers=WAIT).json())["status"] != "ready":
        assert time.monotonic() < deadline, document
    return document


def ended(service, address):
    """A proposal or a search once it is worked out."""
    deadline = time.monotonic() + 100
    while (document := service.http.get(address, headers=WAIT).json())["status"] == "working":
        assert time.monotonic() < deadline, document
    return document


def takes_of(service, identifier):
    """Its takes by animation."""
    listed = service.http.get(f"/v1/collections/{identifier}/takes?limit=100").json()["takes"]
    return {take["animation"]: take for take in listed}


def motions_at(take, seconds=3.0):
    """The motion in the middle of each part of a take."""
    middles = [int(30 * seconds * (part + 0.5)) for part in range(4)]
    return [next(s["motion"] for s in take["segments"] if s["start"] <= at < s["end"]) for at in middles]


@pytest.fixture(scope="module")
def animations(service):
    return [upload(service, performance(order, 100 + place)) for place, order in enumerate(ORDERS)]


@pytest.fixture(scope="module")
def collection(service, animations):
    """Two of the takes, cut together."""
    made = service.http.post("/v1/collections", json={"name": "bars", "animations": animations[:2]})
    assert made.status_code == 201, made.text
    assert made.headers["Location"] == f"/v1/collections/{made.json()['id']}"
    return ready(service, made.json()["id"])


def test_takes_are_cut_into_the_same_motions(service, collection, animations):
    """Whatever each calls its own; the totals are those of all takes, and an exemplar is one of the segments."""
    takes = takes_of(service, collection["id"])
    labels = [motions_at(takes[animation]) for animation in animations[:2]]
    of = dict(zip(ORDERS[0], labels[0], strict=True))
    assert len(set(of.values())) == 2
    assert labels[1] == [of[motion] for motion in ORDERS[1]]
    assert (collection["takes"], collection["waiting"], collection["failed"]) == (2, 0, 0)
    assert {motion["id"] for motion in collection["motions"]} == set(of.values())
    assert sum(motion["seconds"] for motion in collection["motions"]) == pytest.approx(24, abs=0.2)
    for motion in collection["motions"]:
        exemplar = motion["exemplar"]
        segments = takes[exemplar["animation"]]["segments"]
        assert [exemplar["start"], exemplar["end"], motion["id"]] in [
            [s["start"], s["end"], s["motion"]] for s in segments
        ]
        shares = [share for take in takes.values() for share in take["motions"] if share["motion"] == motion["id"]]
        assert (len(shares), sum(share["segments"] for share in shares)) == (motion["takes"], motion["segments"])
    assert len({motion["colour"] for motion in collection["motions"]}) == 2


def test_a_take_added_later_is_labelled_by_the_motions_that_are_known(service, collection, animations):
    """Names and colours of people stay, and so does every other take; it goes again as it came."""
    here = f"/v1/collections/{collection['id']}"
    first = collection["motions"][0]
    named = service.http.patch(f"{here}/motions/{first['id']}", json={"name": "Walk", "colour": "#123456"})
    assert named.status_code == 200
    before = takes_of(service, collection["id"])
    added = service.http.post(f"{here}/takes", json={"animations": [animations[2], animations[0]]})
    assert added.status_code == 202
    after = ready(service, collection["id"])
    takes = takes_of(service, collection["id"])
    assert {name: takes[name] for name in before} == before
    of = dict(zip(ORDERS[0], motions_at(takes[animations[0]]), strict=True))
    assert motions_at(takes[animations[2]]) == [of[motion] for motion in ORDERS[2]]
    kept = next(motion for motion in after["motions"] if motion["id"] == first["id"])
    assert (kept["name"], kept["colour"], kept["named"]) == ("Walk", "#123456", True)
    assert kept["seconds"] > first["seconds"]
    again = service.http.delete(f"{here}/takes/{animations[2]}")
    assert again.status_code == 204
    assert service.http.get(f"{here}/takes/{animations[2]}").status_code == 404
    assert service.http.get(here).json()["takes"] == 2


def test_two_motions_never_share_a_name(service, collection):
    """In any case of letters."""
    here = f"/v1/collections/{collection['id']}/motions"
    one, other = (motion["id"] for motion in collection["motions"][:2])
    assert service.http.patch(f"{here}/{one}", json={"name": "stroll"}).status_code == 200
    refused = service.http.patch(f"{here}/{other}", json={"name": "Stroll "})
    assert (refused.status_code, refused.json()["code"]) == (409, "name-taken")
    assert service.http.patch(f"{here}/nothing", json={"name": "x"}).status_code == 404
    assert service.http.patch(f"{here}/{one}", json={"name": "a\u202eb"}).status_code == 422


def test_a_correction_stays_and_is_proposed_for_others(service, animations):
    """What a person set is theirs; what it says of other takes holds only once it is accepted."""
    made = service.http.post("/v1/collections", json={"name": "corrected", "animations": animations}).json()
    ready(service, made["id"])
    here = f"/v1/collections/{made['id']}"
    before = takes_of(service, made["id"])
    take = before[animations[0]]
    wanted = [{"start": s["start"], "end": s["end"], "motion": s["motion"]} for s in take["segments"]]
    at = next(i for i, s in enumerate(take["segments"]) if s["start"] <= 3.5 * 90 < s["end"])
    wanted[at] = {"start": wanted[at]["start"], "end": wanted[at]["end"], "name": "turn"}
    address = f"{here}/takes/{animations[0]}"
    stale = service.http.patch(address, json={"segments": wanted}, headers={"If-Match": '"77"'})
    assert (stale.status_code, stale.json()["code"]) == (412, "stale-take")
    corrected = service.http.patch(address, json={"segments": wanted}, headers={"If-Match": f'"{take["version"]}"'})
    assert corrected.status_code == 200, corrected.text
    assert [s["corrected"] for s in corrected.json()["segments"]] == [i == at for i in range(len(wanted))]
    turn = corrected.json()["segments"][at]["motion"]
    proposal = ended(service, f"{here}/proposals/{corrected.json()['proposal']}")
    assert proposal["status"] in {"open", "empty"}, proposal
    others = {name: one for name, one in takes_of(service, made["id"]).items() if name != animations[0]}
    assert others == {name: before[name] for name in others}, "nothing holds before it is accepted"
    if proposal["status"] == "open":
        decided = service.http.patch(proposal["links"]["self"], json={"status": "accepted"})
        assert decided.json()["status"] == "accepted"
        changed = takes_of(service, made["id"])
        for change in proposal["changes"]:
            assert changed[change["animation"]]["segments"] == change["segments"]
            assert turn in {s["motion"] for s in change["segments"]}
        again = service.http.patch(proposal["links"]["self"], json={"status": "refused"})
        assert (again.status_code, again.json()["code"]) == (409, "not-open")
    recut = service.http.post(f"{here}/proposals", json={"motions": 3})
    assert recut.status_code == 202
    shown = ended(service, recut.headers["Location"])
    assert shown["status"] in {"open", "empty"}
    for change in shown["changes"]:
        fixed = [s for s in takes_of(service, made["id"])[change["animation"]]["segments"] if s["corrected"]]
        assert all(s in change["segments"] for s in fixed)
    now = service.http.get(here).json()
    if shown["status"] == "open":
        service.http.patch(shown["links"]["self"], json={"status": "refused"})
    assert service.http.get(here).json()["motions"] == now["motions"]
    kinds = [one["kind"] for one in service.http.get(f"{here}/proposals").json()["proposals"]]
    assert kinds == ["recut", "correction"]


@pytest.mark.parametrize(
    ("segments", "code"),
    [
        ([{"start": 0, "end": 10, "motion": "?"}], "invalid-segments"),
        ([{"start": 0, "end": 10, "name": "x"}], "invalid-segments"),
        ([{"start": 5, "end": 10, "name": "x"}], "invalid-segments"),
        ([], "invalid-parameter"),
    ],
)
def test_segments_that_do_not_tile_a_take_are_refused(service, collection, animations, segments, code):
    """With the place that is wrong, and nothing is kept."""
    address = f"/v1/collections/{collection['id']}/takes/{animations[0]}"
    before = service.http.get(address).json()
    refused = service.http.patch(address, json={"segments": segments})
    assert (refused.status_code, refused.json()["code"]) == (422, code)
    assert service.http.get(address).json() == before


def test_an_example_is_found_elsewhere(service, collection, animations):
    """A range of a take of the collection, or of an animation that is not in it, which is analysed first."""
    here = f"/v1/collections/{collection['id']}/searches"
    asked = {"animation": animations[0], "start": 95, "end": 175, "limit": 5}
    begun = service.http.post(here, json=asked)
    assert begun.status_code == 202
    found = ended(service, begun.headers["Location"])
    assert found["status"] == "done", found
    for best in found["found"][:2]:
        order = ORDERS[animations.index(best["animation"])]
        assert order[(best["start"] + best["end"]) // 180] == 1, found
    outside = upload(service, performance((1, 0, 1, 0), 777))
    begun = service.http.post(here, json={"animation": outside, "start": 0, "end": 85, "limit": 3})
    found = ended(service, begun.headers["Location"])
    assert found["status"] == "done", found
    distances = [one["distance"] for one in found["found"]]
    assert distances == sorted(distances)
    wrong = service.http.post(here, json={"animation": animations[0], "start": 300, "end": 100})
    assert ended(service, wrong.headers["Location"])["problem"]["code"] == "outside-take"
    assert service.http.get(f"{here}/nothing").status_code == 404


def test_a_search_knows_takes_that_came_and_went(service, animations):
    """Whichever worker does it, and whatever that one has searched before."""
    made = service.http.post("/v1/collections", json={"name": "searched", "animations": animations[:2]}).json()
    here = f"/v1/collections/{made['id']}"
    ready(service, made["id"])

    def found_in() -> set[str]:
        asked = {"animation": animations[0], "start": 95, "end": 175, "limit": 20}
        begun = [service.http.post(f"{here}/searches", json=asked).headers["Location"] for _ in range(4)]
        found = [ended(service, address)["found"] for address in begun]
        assert all(one == found[0] for one in found)
        return {one["animation"] for one in found[0]}

    assert found_in() == set(animations[:2])
    service.http.post(f"{here}/takes", json={"animations": animations[2:]})
    ready(service, made["id"])
    assert found_in() == set(animations)
    assert service.http.delete(f"{here}/takes/{animations[1]}").status_code == 204
    assert found_in() == {animations[0], animations[2]}


def test_a_take_that_cannot_be_compared_is_named_and_stops_no_other(service, animations):
    """Another body, and one that cannot be read at all."""
    other = upload(service, performance((0, 1, 0, 1), 900, rings=9))
    made = service.http.post("/v1/collections", json={"name": "mixed", "animations": [*animations, other]}).json()
    after = ready(service, made["id"])
    assert after["failed"] == 1
    takes = takes_of(service, made["id"])
    assert takes[other]["problem"]["code"] == "not-comparable"
    assert [takes[animation]["status"] for animation in animations] == ["labelled"] * 3


def test_deleting_an_animation_takes_it_out_of_every_collection(service):
    """With all that it was compared by; a collection is deleted without its animations."""
    pair = [upload(service, performance(order, 300 + place)) for place, order in enumerate(ORDERS[:2])]
    made = [service.http.post("/v1/collections", json={"name": name, "animations": pair}).json()["id"] for name in "ab"]
    for identifier in made:
        assert ready(service, identifier)["takes"] == 2
    stored = len(list((service.data / "blobs" / "collections").iterdir()))
    assert service.http.delete(f"/v1/animations/{pair[0]}").status_code == 204
    for identifier in made:
        assert list(takes_of(service, identifier)) == [pair[1]]
        after = service.http.get(f"/v1/collections/{identifier}").json()
        assert all(motion["exemplar"]["animation"] == pair[1] for motion in after["motions"])
    assert len(list((service.data / "blobs" / "collections").iterdir())) == stored - 6
    assert service.http.delete(f"/v1/collections/{made[0]}").status_code == 204
    assert service.http.get(f"/v1/collections/{made[0]}").status_code == 404
    assert service.http.get(f"/v1/animations/{pair[1]}").status_code == 200
    assert len(list((service.data / "blobs" / "collections").iterdir())) == stored - 6 - 4


def test_an_empty_collection_begins_with_its_first_take(service, animations):
    """One take has its own motions; the next ones are labelled by them."""
    made = service.http.post("/v1/collections", json={"name": "later"})
    assert (made.status_code, made.json()["status"]) == (201, "ready")
    for count, animation in enumerate(animations[:2], 1):
        added = service.http.post(f"/v1/collections/{made.json()['id']}/takes", json={"animations": [animation]})
        assert added.status_code == 202
        assert ready(service, made.json()["id"])["takes"] == count
    assert all(take["status"] == "labelled" for take in takes_of(service, made.json()["id"]).values())


def test_a_collection_has_no_more_than_the_operator_allows(idle):
    """Takes of two days together are too many, whatever each is; nothing of them is added."""
    long = square()
    long.animate(0, "translation", [0, 50_000], np.eye(3)[:2])
    other = square()
    other.animate(0, "translation", [0, 50_000], np.eye(3)[1:])
    pair = [idle.http.post("/v1/animations", content=one.glb()).json()["id"] for one in (long, other)]
    made = idle.http.post("/v1/collections", json={"name": "long", "animations": pair[:1]}).json()
    here = f"/v1/collections/{made['id']}"
    refused = idle.http.post(f"{here}/takes", json={"animations": pair})
    assert (refused.status_code, refused.json()["code"]) == (409, "too-many-takes")
    assert refused.json()["setting"] == "CAESURA_MAX_COLLECTION_SECONDS"
    after = idle.http.get(here).json()
    assert (after["takes"], after["waiting"], after["status"]) == (1, 1, "working")
    assert idle.http.post(f"{here}/takes", json={"animations": ["x" * 26]}).status_code == 404
    assert idle.http.post(f"{here}/takes", json={"animations": ["x"] * 1001}).status_code == 422
    listed = [one["id"] for one in idle.http.get("/v1/collections?limit=1").json()["collections"]]
    assert listed == [made["id"]]
    assert idle.http.patch(here, json={"name": " renamed "}).json()["name"] == "renamed"
