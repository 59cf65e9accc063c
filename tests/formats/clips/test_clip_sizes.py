"""A file in clips is hardly larger than it was: what it has of the take is told once."""

import io
import json
import zipfile

import numpy as np
import pytest

from tests.formats.clips.making import chunks_of, clips_of, cut_at, worst_miss
from tests.formats.opening import opened
from tests.glb import Glb, bending_strip

CLOSE = 1e-5
CUTS = [11, 24, 39]


def swaying(keys: int = 61, interpolation: str = "LINEAR") -> Glb:
    """The bending strip, its joint turned and its root moved, a key at each of 30 frames a second."""
    model, times = bending_strip(), np.arange(keys) / 30
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    turns = np.stack([0 * times, 0 * times, np.sin(np.sin(times)), np.cos(np.sin(times))], axis=1)
    moves = np.stack([np.sin(2 * times), np.cos(3 * times), times], axis=1)
    if interpolation == "CUBICSPLINE":
        turns, moves = (np.stack([v * 0, v, v * 0], axis=1).reshape(-1, v.shape[1]) for v in (turns, moves))
    model.animate(2, "rotation", times, turns, interpolation)
    model.animate(1, "translation", times, moves, interpolation)
    return model


@pytest.mark.parametrize(("interpolation", "parts"), [("LINEAR", 1), ("CUBICSPLINE", 3)])
def test_a_cut_between_keys_adds_two_keys(interpolation, parts):
    """The pose there ends one clip and begins the next; the take's own keys are gone."""
    data = swaying(interpolation=interpolation).glb()
    glb = clips_of(data, cut_at(opened(data, fps=29), CUTS))
    before, after = len(chunks_of(data)[1]), len(chunks_of(glb)[1])
    poses, times = 2 * parts * (16 + 12) * len(CUTS), 4 * (61 + 2 * len(CUTS)) - 2 * 4 * 61
    assert after <= before + poses + times + 32  # alignment of views that are appended and not packed
    assert worst_miss(opened(data, fps=29), glb, cut_at(opened(data, fps=29), CUTS)) <= CLOSE


def test_defaults_are_not_written():
    """What an exporter said of its accessors without need is not said again for each clip."""
    model = swaying()
    for accessor in model.json["accessors"]:
        accessor |= {"normalized": False, "byteOffset": 0}
    data = model.glb()
    root, _ = chunks_of(clips_of(data, cut_at(opened(data), CUTS)))
    for animation in root["animations"]:
        for sampler in animation["samplers"]:
            assert "interpolation" not in sampler
            for number in sampler.values():
                assert "normalized" not in root["accessors"][number]
                assert root["accessors"][number].get("byteOffset") != 0


@pytest.mark.parametrize("name", ["関節", "\ud800"])
def test_names_of_any_script_are_as_short_as_they_were(name):
    """As letters of UTF-8; half a letter, which UTF-8 cannot say, as a number."""
    model = swaying()
    model.json["nodes"][1]["name"] = name
    data = model.glb()
    glb = clips_of(data, cut_at(opened(data), CUTS))
    assert chunks_of(glb)[0]["nodes"][1]["name"] == name
    assert (name.encode(errors="ignore") or b"\\ud800") in glb
    assert json.dumps(name).encode() not in glb or name == "\ud800"


def with_an_image(**view: object) -> bytes:
    """The swaying strip, each of its channels with times of its own, and behind them an image."""
    model = swaying(601)
    model.json["images"] = [{"bufferView": model.view(b"\x89PNG not really", **view), "mimeType": "image/png"}]
    return model.glb()


def test_room_that_is_left_is_cut_out():
    """Of times told twice one is enough; what lies behind them is the same, and aligned as it was."""
    data = with_an_image()
    document = cut_at(opened(data), CUTS)
    glb = clips_of(data, document)
    (before, old), (after, new) = chunks_of(data), chunks_of(glb)
    assert len(new) <= len(old) - 4 * 601 + 8 * len(CUTS) + 16
    assert worst_miss(opened(data), glb, document) <= CLOSE
    places = [root["bufferViews"][root["images"][0]["bufferView"]] for root in (before, after)]
    assert new[places[1]["byteOffset"] :][: places[1]["byteLength"]] == b"\x89PNG not really"
    assert (places[0]["byteOffset"] - places[1]["byteOffset"]) % 8 == 0
    assert places[1]["byteOffset"] < places[0]["byteOffset"]


@pytest.mark.parametrize("files", ["one", "separate"])
def test_bytes_that_nothing_refers_to_are_not_copied(files):
    """Be they in a view that nobody names, or in none."""
    model = swaying()
    model.view(bytes(50_000))
    model.binary += bytes(50_000)
    data = model.glb()
    made = clips_of(data, cut_at(opened(data), CUTS), files=files)
    if files == "one":
        assert len(made) < len(data) - 90_000
        return
    with zipfile.ZipFile(io.BytesIO(made)) as archive:
        assert max(member.file_size for member in archive.infolist()) < len(data) - 90_000


def test_nothing_moves_where_an_extension_may_say_where_it_lies():
    """What is not known here may count bytes of the file."""
    data = with_an_image(extensions={"EXT_unknown": {"from": 12}})
    root, _ = chunks_of(clips_of(data, cut_at(opened(data), CUTS)))
    number = root["images"][0]["bufferView"]
    assert root["bufferViews"][number] == chunks_of(data)[0]["bufferViews"][number]
