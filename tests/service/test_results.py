"""A result comes in every form a person's tools read, is cached by its tag, and says what it is."""

import csv
import io
import json
from xml.etree import ElementTree

import numpy as np
import pytest

from caesura.core.segmentation_document import SegmentationDocument
from tests.glb import moving_square


@pytest.fixture(scope="module")
def address(service, take):
    """Where a finished segmentation of three motions is."""
    answer = service.http.post("/v1/segmentations?motions=3", content=take(401), headers={"Prefer": "wait=30"})
    assert answer.status_code == 200, answer.text
    return answer.headers["Location"]


@pytest.fixture(scope="module")
def document(service, address):
    return service.http.get(f"{address}/result").json()


def rows(answer):
    return list(csv.DictReader(io.StringIO(answer.text)))


def test_the_document_is_whole(service, address, document):
    """The segmentation document: one energy for each frame, segments that tile, the id it is asked by."""
    found = SegmentationDocument.model_validate(document)
    assert found.id == address.rpartition("/")[2]
    assert len(found.energy) == found.frames == 240
    assert found.segments[0].start == 0
    assert found.segments[-1].end == 240


def test_the_csv_has_a_row_for_each_segment(service, address, document):
    """The same cuts as the document's, in seconds of the file's clock too."""
    answer = service.http.get(f"{address}/result.csv")
    assert answer.headers["Content-Type"].startswith("text/csv")
    assert answer.text.startswith("name,motion,start,end,start_seconds,end_seconds,confidence,loop,discard\n")
    assert [(r["name"], int(r["start"]), int(r["end"])) for r in rows(answer)] == [
        (s["name"], s["start"], s["end"]) for s in document["segments"]
    ]


def test_the_frames_table_has_a_row_for_each_frame(service, address, document):
    """Its motions tile the take as the segments do; its energies are the curve."""
    table = rows(service.http.get(f"{address}/result.csv", params={"table": "frames"}))
    assert [int(row["frame"]) for row in table] == list(range(240))
    assert [float(row["energy"]) if row["energy"] else None for row in table] == document["energy"]
    assert [row["frame"] for row in table if row["key_frame"] == "1"] == [
        str(k["frame"]) for k in document["key_frames"]
    ]


def test_the_vtt_has_a_cue_for_each_segment(service, address, document):
    """Clock times that a player reads."""
    answer = service.http.get(f"{address}/result.vtt")
    assert answer.text.startswith("WEBVTT\n\n00:00:00.000 --> ")
    assert answer.text.count(" --> ") == len(document["segments"])


def test_the_npz_holds_the_arrays(service, address, document):
    """Made by a worker at the first request, then read by Range like any file."""
    answer = service.http.get(f"{address}/result.npz", headers={"Prefer": "wait=20"})
    assert answer.status_code == 200
    with np.load(io.BytesIO(answer.content), allow_pickle=False) as arrays:
        assert arrays["energy"].shape == arrays["labels"].shape == (240,)
        assert len(arrays["segments"]) == len(document["segments"])
    part = service.http.get(f"{address}/result.npz", headers={"Range": "bytes=0-3"})
    assert (part.status_code, part.content) == (206, answer.content[:4])


def test_elan_reads_it(service, address, document):
    """An annotation of each segment and of each key-frame."""
    answer = service.http.get(f"{address}/result.eaf")
    assert answer.headers["Content-Type"].startswith("text/x-eaf+xml")
    tiers = {tier.get("TIER_ID"): len(tier) for tier in ElementTree.fromstring(answer.text).iter("TIER")}
    assert tiers["motions"] == len(document["segments"])
    assert tiers["key-frames"] == len(document["key_frames"])


def test_every_file_is_saved_under_the_name_of_the_animation_and_its_take(service, take):
    """`walk.csv`, and of a file with several takes `walk-NAME.csv`; the ids are for programs."""
    model = moving_square()
    (one,) = model.json["animations"]
    ask = {"headers": {"Prefer": "wait=30"}}
    model.json["animations"] = [{**one, "name": name} for name in ("in/place", "away")]
    for name, content, stem in (("walk.npz", take(402), "walk"), ("two takes.glb", model.glb(), "two takes-away")):
        query = {"name": name} | ({"take": "away"} if "two" in name else {})
        address = service.http.post("/v1/segmentations", params=query, content=content, **ask).headers["Location"]
        for path, ending in (
            ("result.json", ".json"), ("result.csv", ".csv"), ("result.csv?table=frames", ".frames.csv"),
            ("plot.svg", ".svg"), ("result.npz", ".npz"),
        ):  # fmt: skip
            saved = service.http.get(f"{address}/{path}", **ask).headers["Content-Disposition"]
            assert f'filename="{stem}{ending}"' in saved


def test_there_is_a_plot_of_it(service, address):
    """As text at once, as pixels made by a worker; no script could run in it."""
    drawn = service.http.get(f"{address}/plot.svg")
    assert (drawn.status_code, drawn.headers["Content-Type"].partition(";")[0]) == (200, "image/svg+xml")
    assert drawn.text.startswith("<svg ")
    assert "default-src 'none'" in drawn.headers["Content-Security-Policy"]
    pixels = service.http.get(f"{address}/plot.png", headers={"Prefer": "wait=20"})
    assert (pixels.status_code, pixels.headers["Content-Type"]) == (200, "image/png")
    assert pixels.content.startswith(b"\x89PNG")
    assert service.http.get(f"{address}/plot.pdf").status_code == 404


@pytest.mark.parametrize(
    ("accept", "media_type"),
    [
        ("*/*", "application/json"),
        ("text/csv", "text/csv"),
        ("text/*;q=0.5, text/vtt", "text/vtt"),
        ("text/html, application/json;q=0.9", "application/json"),
    ],
)
def test_the_form_is_the_one_that_accept_likes_best(service, address, accept, media_type):
    """By quality, the most specific pattern counting."""
    answer = service.http.get(f"{address}/result", headers={"Accept": accept})
    assert answer.status_code == 200
    assert answer.headers["Content-Type"].partition(";")[0] == media_type


def test_a_form_that_there_is_not_is_refused_with_those_there_are(service, address):
    """406 by header, 404 by name, 400 for a table that the form does not have."""
    asked = [
        service.http.get(f"{address}/result", headers={"Accept": "image/png"}),
        service.http.get(f"{address}/result.xml"),
        service.http.get(f"{address}/result?table=frames", headers={"Accept": "text/vtt"}),
    ]
    assert [answer.status_code for answer in asked] == [406, 404, 400]
    assert all("csv" in answer.json()["detail"] for answer in asked)


@pytest.mark.parametrize(
    "path", ["result", "result.csv", "result.csv?table=frames", "result.eaf", "plot.svg", "viewer/model"]
)
def test_what_does_not_change_is_not_sent_twice(service, address, path):
    """304 to who sends the tag back; each form has a tag of its own."""
    first = service.http.get(f"{address}/{path}")
    again = service.http.get(f"{address}/{path}", headers={"If-None-Match": f'"other", {first.headers["ETag"]}'})
    assert (first.status_code, again.status_code, again.content) == (200, 304, b"")
    assert again.headers["ETag"] == first.headers["ETag"]


def test_another_cut_of_the_same_take_shares_its_figure(service, take, address):
    """A new K is cut from the stored analysis: the page plays the same bytes."""
    other = service.http.post("/v1/segmentations?motions=2", content=take(401), headers={"Prefer": "wait=30"})
    tags = {service.http.get(f"{a}/viewer/model").headers["ETag"] for a in (address, other.headers["Location"])}
    assert len(tags) == 1


def test_the_page_is_told_what_to_play(service, address):
    """Its addresses answer by Range, without a compression that would spoil the offsets."""
    shown = service.http.get(f"{address}/viewer").json()
    assert shown["kind"] == "vertices"
    assert shown["frames"] == 240
    for part in (shown["model"], shown["strain"]):
        answer = service.http.get(part, headers={"Range": "bytes=0-7", "Accept-Encoding": "gzip"})
        assert answer.status_code == 206
        assert len(answer.content) == 8
        assert "Content-Encoding" not in answer.headers


def test_text_is_compressed_for_who_takes_it(service, address):
    """The document goes over the wire as gzip."""
    answer = service.http.get(f"{address}/result", headers={"Accept-Encoding": "gzip"})
    assert answer.headers["Content-Encoding"] == "gzip"
    assert json.loads(answer.text)["frames"] == 240


@pytest.mark.parametrize("trick", [":document", ":energy", ":labels", "%3Adocument", "%00", "%0a", "*", "?x=1%00"])
def test_an_address_that_is_nearly_an_id_is_none(service, address, trick):
    """What Redis holds under names that begin with the id is no segmentation."""
    answer = service.http.get(address + trick)
    assert answer.status_code == (422 if "?" in trick else 404), answer.text
