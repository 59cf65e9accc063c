"""What a clip does not need it does not copy: large `extras`, and files beside the model that nothing refers to."""

import io
import json
import zipfile

import numpy as np
import pytest

from tests.formats.clips.making import chunks_of, clips_of, cut_at
from tests.formats.opening import opened
from tests.glb import Glb, moving_square

CUTS = [7, 15, 22]
LARGE = {"data": "x" * 1_000_000}
SMALL = {"licence": "CC-BY-4.0"}


def laden() -> Glb:
    """A square that moves, with a megabyte of the author's data in each of six places, and little in two."""
    model = moving_square()
    animation = model.json["animations"][0]
    places = [model.json, model.json["nodes"][0], model.json["meshes"][0], animation]
    for place in [*places, animation["samplers"][0], animation["channels"][0]["target"]]:
        place["extras"] = LARGE
    model.json["asset"]["extras"] = model.json["scenes"][0]["extras"] = SMALL
    return model


def separate(data) -> list[bytes]:
    """The clips in files of their own."""
    document = cut_at(opened(data, fps=30), CUTS)
    with zipfile.ZipFile(io.BytesIO(clips_of(data, document, files="separate"))) as archive:
        return [archive.read(name) for name in archive.namelist()]


@pytest.mark.parametrize("container", ["glb", "gltf"])
def test_clips_in_files_of_their_own_hold_little_of_the_authors_data(container):
    """Some kilobytes, such as a licence, are in each; what is longer is in none."""
    files = separate(getattr(laden(), container)())
    assert len(files) == len(CUTS) + 1
    assert max(map(len, files)) < 10_000
    for file in files:
        root, _ = chunks_of(file)
        assert root["asset"]["extras"] == root["scenes"][0]["extras"] == SMALL
        assert "extras" not in root
        assert opened(file, fps=30).vertex_count == 4


def test_clips_in_one_file_hold_the_takes_data_at_most_once():
    """All of the rest is as it was; what the take itself says at length is not said by every clip."""
    data = laden().glb()
    one = clips_of(data, cut_at(opened(data, fps=30), CUTS))
    root, _ = chunks_of(one)
    assert root["extras"] == root["nodes"][0]["extras"] == root["meshes"][0]["extras"] == LARGE
    assert len(one) < 3.1e6
    kept = clips_of(data, cut_at(opened(data, fps=30), CUTS), keep_source=True)
    assert chunks_of(kept)[0]["animations"][0]["extras"] == LARGE


def test_files_beside_the_model_that_nothing_refers_to_stay_out():
    """A buffer without a view, an image without a texture; an image that an extension shows comes in."""
    model = moving_square()
    noise = np.random.default_rng(3).bytes(300_000)
    used = {"sampler": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}
    root = {
        **model.complete(),
        "images": [{"uri": "unused.png"}, {"uri": "used.webp"}],
        "textures": [used],
        "samplers": [{}],
    }
    root["buffers"] = [{**root["buffers"][0], "uri": "model.bin"}, {"byteLength": len(noise), "uri": "unused.bin"}]
    parts = {"model.gltf": json.dumps(root).encode(), "model.bin": bytes(model.binary), "unused.bin": noise}
    parts |= {"unused.png": noise, "used.webp": noise[:1000]}
    glb = clips_of(parts, cut_at(opened(parts, fps=30), CUTS))
    images = chunks_of(glb)[0]["images"]
    assert len(glb) < 20_000
    assert images[0] == {"uri": "unused.png"}
    assert images[1]["mimeType"] == "image/webp"
