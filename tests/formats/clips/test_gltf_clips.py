"""A take in clips moves as it did, and what is not the take stays as it was."""

import io
import json
import zipfile

import numpy as np
import pytest

from caesura.core.document import Interval
from caesura.core.errors import ParameterError
from tests.formats.clips.making import chunks_of, clips_of, cut_at, names_of, worst_miss
from tests.formats.opening import opened
from tests.glb import Glb, bending_strip, moving_square, square

CLOSE = 1e-5


def turning(interpolation: str, times: list[float], rng: np.random.Generator) -> Glb:
    """The bending strip, its joint turned and its target widened by keys of this kind, each at its own times."""
    model = bending_strip()
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    turns = rng.normal(size=(len(times), 4)) * [0.3, 0.3, 0.3, 0] + [0, 0, 0, 1]
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    moves, widths = rng.normal(size=(len(times) - 1, 3)), rng.normal(size=(len(times), 1))
    later = [t + 0.013 for t in times[:-1]]
    if interpolation == "CUBICSPLINE":
        turns, moves, widths = (
            np.stack([rng.normal(size=v.shape) * 0.4, v, rng.normal(size=v.shape) * 0.4], 1).reshape(-1, v.shape[1])
            for v in (turns, moves, widths)
        )
    model.animate(2, "rotation", times, turns, interpolation)
    model.animate(1, "translation", later, moves, interpolation)
    model.animate(0, "weights", times, widths, interpolation)
    return model


@pytest.mark.parametrize("interpolation", ["LINEAR", "STEP", "CUBICSPLINE"])
@pytest.mark.parametrize("times", [[0, 0.31, 0.77, 1.21, 2.03], [0.2, 1.9], np.linspace(0, 2, 61).tolist()])
def test_every_clip_moves_as_the_take_does(interpolation, times):
    """Cut on keys and between them: drawn 240 times a second, all vertices are where the take has them."""
    data = turning(interpolation, times, np.random.default_rng(5)).glb()
    take = opened(data, fps=30)
    document = cut_at(take, [7, 13, 14, 40])
    glb = clips_of(data, document)
    if interpolation == "STEP":
        assert_steps_agree(data, glb, document)
    else:
        assert worst_miss(opened(data, fps=240), glb, document) <= CLOSE


def assert_steps_agree(data, glb, document):
    """Every clip's poses between frames are the take's there; on a frame, rounding decides which is the newer one."""
    fine = opened(data, fps=60)
    for name, segment in zip(names_of(glb), document.segments, strict=True):
        clip = opened(glb, take=name, fps=60)
        for frame in range(1, min(2 * (segment.end - segment.start), clip.frames), 2):
            at = 2 * segment.start + frame
            np.testing.assert_allclose(clip.vertices(frame, frame + 1), fine.vertices(at, at + 1), atol=1e-6)


@pytest.mark.parametrize("interpolation", ["LINEAR", "STEP", "CUBICSPLINE"])
def test_clips_span_their_seconds(interpolation):
    """Each begins at 0 and is as long as its frames; the last ends with the take."""
    data = turning(interpolation, [0, 0.4, 1.01, 2.02], np.random.default_rng(1)).glb()
    document = cut_at(opened(data, fps=30), [10, 41])
    root, _ = chunks_of(clips_of(data, document))
    for animation, (start, end) in zip(
        root["animations"], [(0, 10 / 30), (10 / 30, 41 / 30), (41 / 30, 2.02)], strict=True
    ):
        times = [root["accessors"][sampler["input"]] for sampler in animation["samplers"]]
        assert {t["min"][0] for t in times} == {0}
        assert max(t["max"][0] for t in times) == pytest.approx(end - start, abs=1e-6)
        said = animation["extras"]["caesura"]
        assert (said["start_seconds"], said["end_seconds"]) == pytest.approx((start, end), abs=1e-6)
        assert said["segmentation"] == document.id


def test_a_clip_in_which_nothing_moves_is_as_long_as_it_should_be():
    """Keys that are all the same become one, but one channel at least says how long it lasts."""
    model = square()
    model.animate(0, "translation", [0, 1, 2], [[0, 0, 0], [0, 0, 0], [1, 0, 0]])
    data = model.glb()
    glb = clips_of(data, cut_at(opened(data, fps=30), [15, 30]))
    assert [opened(glb, take=name).take.duration_seconds for name in names_of(glb)] == pytest.approx([0.5, 0.5, 1])


@pytest.mark.parametrize("kind", ["int8", "int16"])
def test_quantised_keys_stay_as_they_are_stored(kind):
    """Cut on keys, a clip's values are a window of the take's own bytes, of their own type."""
    model, most = square(), {"int8": 127, "int16": 32767}[kind]
    times = np.arange(31) / 30
    turns = np.round(np.stack([0 * times, 0 * times, np.sin(times), np.cos(times)], 1) * most)
    sampler = {"input": model.accessor(times), "output": model.accessor(turns, kind, normalized=True)}
    channel = {"sampler": 0, "target": {"node": 0, "path": "rotation"}}
    model.json["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    data = model.glb()
    take = opened(data)
    for document in (cut_at(take, [10, 20]), cut_at(opened(data, fps=24), [10])):
        glb = clips_of(data, document)
        assert worst_miss(opened(data, fps=document.frame_rate), glb, document) <= CLOSE
    root, binary = chunks_of(clips_of(data, cut_at(take, [10, 20])))
    for animation in root["animations"]:
        output = root["accessors"][animation["samplers"][0]["output"]]
        assert (output["componentType"], output["normalized"]) == ({"int8": 5120, "int16": 5122}[kind], True)
    assert turns.astype(kind).tobytes() in binary


def test_sparse_keys_are_decoded():
    """Weights whose accessor is sparse, cut on keys and between them."""
    model = bending_strip()
    weights = model.json["accessors"][model.json["animations"][0]["samplers"][1]["output"]]
    del weights["bufferView"]
    indices, values = model.view(np.array([1], np.uint16).tobytes()), model.view(np.array([1], "<f4").tobytes())
    weights["sparse"] = {
        "count": 1, "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values},
    }  # fmt: skip
    data = model.glb()
    document = cut_at(opened(data, fps=30), [7, 15])
    assert worst_miss(opened(data, fps=30), clips_of(data, document), document) <= CLOSE


def furnished() -> Glb:
    """A moving square with materials, an image, extensions, extras, and an animation besides the take."""
    model = moving_square()
    model.json["animations"][0] |= {"name": "take", "extras": {"by": "somebody"}}
    view = model.view(b"\x89PNG not really")
    model.json |= {
        "images": [{"bufferView": view, "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"name": "skin", "extensions": {"KHR_materials_unlit": {}}, "extras": {"layer": [1, 2.5]}}],
        "extensionsUsed": ["KHR_materials_unlit", "EXT_unknown"],
        "extensions": {"EXT_unknown": {"accessor": 2}},
        "extras": {"scene": "ünïcode"},
    }
    sampler = {"input": model.accessor([0, 1]), "output": model.accessor([[0, 0, 0], [0, 1, 0]])}
    channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
    model.json["animations"].append({"name": "A_01", "samplers": [sampler], "channels": [channel]})
    return model


def without_animations(root):
    """All of a JSON but what clips are made of."""
    return {k: v for k, v in root.items() if k not in {"animations", "accessors", "bufferViews", "buffers"}}


@pytest.mark.parametrize("options", [{}, {"keep_source": True}])
def test_what_is_not_the_take_is_untouched(options):
    """Materials, images, extensions, extras, other animations: the same JSON, the same numbers, the same bytes."""
    data = furnished().glb()
    before, old = chunks_of(data)
    after, new = chunks_of(clips_of(data, cut_at(opened(data, take="take"), [11, 21]), **options))
    assert without_animations(after) == without_animations(before)
    assert after["animations"][-1] == before["animations"][-1]
    kept = range(len(before["accessors"])) if options else {0, 1, 2, *(len(before["accessors"]) - n for n in (1, 2))}
    for number in kept:
        assert after["accessors"][number] == before["accessors"][number]
        view = before["accessors"][number]["bufferView"]
        assert bytes_of(after, new, view) == bytes_of(before, old, view)
    assert bytes_of(after, new, before["images"][0]["bufferView"]) == b"\x89PNG not really"
    if options:
        assert new[: len(old)] == old
        assert after["animations"][0] == before["animations"][0]


def bytes_of(root, binary, number):
    view = root["bufferViews"][number]
    return binary[view.get("byteOffset", 0) :][: view["byteLength"]]


def test_names_are_unique_among_the_animations_that_stay():
    """The file has an A_01 already; the take's own extras stay on its clips."""
    data = furnished().glb()
    document = cut_at(opened(data, take="take"), [11, 21], ["A", "wa.lk/[x]", "A"])
    root, _ = chunks_of(clips_of(data, document, loop="A"))
    assert [a["name"] for a in root["animations"]] == ["A_01-loop", "wa_lk_x_01", "A_02-loop", "A_01"]
    assert {a["extras"]["by"] for a in root["animations"][:-1]} == {"somebody"}


def test_handles_and_origin():
    """Frames on either side, as far as the take goes; or each clip at its own time in the take."""
    data = moving_square().glb()
    document = cut_at(opened(data), [10, 20])
    with_handles = clips_of(data, document, handles_seconds=0.2)
    lengths = [opened(with_handles, take=n).take.duration_seconds for n in names_of(with_handles)]
    assert lengths == pytest.approx([10 / 30 + 0.2, 10 / 30 + 0.4, 10 / 30 + 0.2], abs=1e-6)
    root, _ = chunks_of(clips_of(data, document, origin="keep"))
    inputs = [root["accessors"][a["samplers"][0]["input"]] for a in root["animations"]]
    assert [i["min"][0] for i in inputs] == pytest.approx([0, 1 / 3, 2 / 3])
    assert [i["max"][0] for i in inputs] == pytest.approx([1 / 3, 2 / 3, 1])


def test_handles_that_repeat_the_take_over_and_over_are_refused():
    """A thousand short clips with long handles would be a file without end."""
    model = square()
    model.animate(0, "translation", [0, 100], [[0, 0, 0], [1, 0, 0]])
    data = model.glb()
    document = cut_at(opened(data, fps=30), range(10, 3000, 10))
    assert len(names_of(clips_of(data, document, handles_seconds=0.3))) == 300
    with pytest.raises(ParameterError) as refused:
        clips_of(data, document, handles_seconds=30)
    assert refused.value.code == "handles-too-long"


def test_what_is_discarded_or_short_is_no_clip():
    """By name or by length; nothing left, or a name that there is not, is refused."""
    data = moving_square().glb()
    document = cut_at(opened(data), [10, 12])
    assert names_of(clips_of(data, document, discard="B")) == ["A_01", "A_02"]
    assert names_of(clips_of(data, document, min_seconds=0.1)) == ["A_01", "A_02"]
    for options, code in (({"discard": "A, B"}, "no-clips"), ({"loop": "C"}, "unknown-motion")):
        with pytest.raises(ParameterError) as refused:
            clips_of(data, document, **options)
        assert refused.value.code == code


def test_repeats_become_clips_of_their_own():
    """One for each repetition, where there are several."""
    data = moving_square().glb()
    document = cut_at(opened(data), [20])
    repeats = (Interval(start=0, end=9), Interval(start=9, end=20))
    first = document.segments[0].model_copy(update={"repeats": repeats})
    document = document.model_copy(update={"segments": (first, document.segments[1])})
    assert names_of(clips_of(data, document, split_repeats=True)) == ["A_01", "A_02", "B_01"]


@pytest.mark.parametrize("animation_only", [False, True])
def test_separate_files(animation_only):
    """A zip of a GLB for each clip, with the model or with its nodes alone, and no other animation."""
    data = furnished().glb()
    document = cut_at(opened(data, take="take"), [11])
    made = clips_of(data, document, files="separate", animation_only=animation_only)
    assert made == clips_of(data, document, files="separate", animation_only=animation_only)
    with zipfile.ZipFile(io.BytesIO(made)) as archive:
        assert archive.namelist() == ["A_01.glb", "B_01.glb"]
        for name in archive.namelist():
            root, _ = chunks_of(archive.read(name))
            assert [a["name"] for a in root["animations"]] == [name[:-4]]
            assert ("meshes" in root, "images" in root) == (not animation_only, not animation_only)
            if not animation_only:
                assert opened(archive.read(name)).vertex_count == 4


def test_several_files_become_one():
    """Buffers sent beside the model, data within its JSON, and an image that came with it: all in one GLB."""
    model = furnished()
    root = model.complete()
    root["buffers"][0]["uri"] = "model%20data.bin"
    root["images"].append({"uri": "cloth.png"})
    parts = {"model.gltf": json.dumps(root).encode(), "model data.bin": bytes(model.binary), "cloth.png": b"PNG!"}
    document = cut_at(opened(parts, take="take"), [11])
    for data in (parts, model.gltf()):
        glb = clips_of(data, document)
        after, _ = chunks_of(glb)
        assert "uri" not in after["buffers"][0]
        assert len(after["buffers"]) == 1
        assert worst_miss(opened(model.glb(), take="take"), glb, document) <= CLOSE
    assert bytes_of(*chunks_of(clips_of(parts, document)), len(root["bufferViews"])) == b"PNG!"


@pytest.mark.parametrize("fps", [30, 24])
def test_a_long_take_grows_by_little(fps):
    """Cut on keys or between them, the file stays below 1.1 times its size: old keys make room for new ones."""
    model = bending_strip()
    model.json["animations"] = [{"samplers": [], "channels": []}]
    times = np.arange(3001) / 30
    angle = 0.5 * np.sin(times)
    model.animate(2, "rotation", times, np.stack([0 * times, 0 * times, np.sin(angle), np.cos(angle)], 1))
    model.animate(1, "translation", times, np.stack([np.sin(times), np.cos(times), 0 * times], 1))
    data = model.glb()
    document = cut_at(opened(data, fps=fps), list(range(100, 2000, 200)))
    glb = clips_of(data, document)
    assert len(glb) <= 1.1 * len(data)
    assert worst_miss(opened(data, fps=fps), glb, document) <= CLOSE
