"""Pictures of poses are kept with a result: once, for its owner, and no longer than the result."""

import struct
from base64 import b64decode, b64encode
from pathlib import Path
from typing import Any

import pytest

FRAMES = [0, 30, 100]


def png(width: int, height: int) -> bytes:
    """The first bytes of a PNG of this size, with something after them."""
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", width, height) + b"\x08\x06\0\0\0drawn"


def pictures(**changes: Any) -> dict[str, Any]:
    """A body that is right but for the changes."""
    sheet, poster = (b64encode(png(width, 72)).decode() for width in (3 * 96, 96))
    return {"width": 96, "height": 72, "frames": FRAMES, "sheet": sheet, "poster": poster} | changes


@pytest.fixture
def address(service, take, request):
    """Where a finished result is."""
    seed = 9000 + sum(map(ord, request.node.name))
    answer = service.http.post("/v1/segmentations?motions=3", content=take(seed), headers={"Prefer": "wait=30"})
    assert answer.status_code == 200, answer.text
    yield answer.headers["Location"]
    service.http.delete(answer.headers["Location"])


def kept_files(service) -> set[Path]:
    """The files made of results that the store holds."""
    return {path for path in service.data.rglob("*") if path.is_file() and path.parent.name == "exports"}


def test_pictures_are_kept_once_and_go_with_the_result(service, address) -> None:
    """Nothing before they were sent; then the same for everybody, whatever is sent later; then nothing again."""
    assert service.http.get(f"{address}/pictures").status_code == 204
    before = kept_files(service)
    assert service.http.put(f"{address}/pictures", json=pictures()).status_code == 204
    late = pictures(frames=[5, 6, 7])
    assert service.http.put(f"{address}/pictures", json=late).status_code == 204
    found = service.http.get(f"{address}/pictures").json()
    assert found["frames"] == FRAMES
    assert b64decode(found["sheet"]) == png(3 * 96, 72)
    poster = service.http.get(f"{address}/poster")
    assert (poster.headers["Content-Type"], poster.content) == ("image/png", png(96, 72))
    tag = poster.headers["ETag"]
    assert service.http.get(f"{address}/poster", headers={"If-None-Match": tag}).status_code == 304
    assert len(kept_files(service) - before) == 2
    service.http.delete(address)
    assert kept_files(service) <= before
    assert service.http.get(f"{address}/poster").json()["code"] == "not-found"


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"frames": [0, 30, 240]}, "/frames"),
        ({"frames": []}, "/frames"),
        ({"frames": [0, -1, 2]}, "/frames/1"),
        ({"width": 95}, ""),
        ({"sheet": "PHN2Zz4="}, ""),
        ({"poster": 7}, "/poster"),
        ({"name": "x"}, "/name"),
    ],
    ids=["no such frame", "none", "negative", "another size", "no image", "a number", "unknown"],
)
def test_what_are_no_pictures_is_refused(service, address, changes, pointer) -> None:
    """With a pointer to the fault; and nothing is kept."""
    problem = service.http.put(f"{address}/pictures", json=pictures(**changes)).json()
    assert (problem["code"], problem["pointer"]) == ("invalid-parameter", pointer)
    assert service.http.get(f"{address}/pictures").status_code == 204


def test_more_than_pictures_are_is_refused_by_its_length(service, address) -> None:
    """As every JSON is."""
    answer = service.http.put(f"{address}/pictures", json=pictures(sheet="A" * 300_000))
    assert "longer than 262144 bytes" in answer.json()["detail"]
