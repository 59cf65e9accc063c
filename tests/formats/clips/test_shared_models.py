"""Clips of models that people share, by our own reader and by three.js: names, lengths, and every vertex."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tests.formats.clips.making import chunks_of, clips_of, cut_at, names_of, worst_miss
from tests.formats.opening import opened

CLOSE = 1e-5
RATES = {"gltf": 29, "takes": 7}  # so that frames fall between keys, and there are not too many of a long take
MODELS = [
    ("gltf/Fox.glb", 0, [1, 2]),
    ("gltf/CesiumMan.glb", 0, [1]),
    ("gltf/Horse.glb", 0, [1]),
    *(("gltf/InterpolationTest/InterpolationTest.gltf", take, [1]) for take in range(9)),
    ("takes/fox_hard_0.glb", 0, [6, 17]),
    ("takes/fox_hard_1.glb", 0, [4, 9, 16]),
    ("takes/godotman_hard_0.glb", 0, [8]),
    ("takes/godotman_hard_1.glb", 0, [5, 13, 21]),
    ("takes/ybot_hard_0.glb", 0, [11]),
]


def parts_of(path: Path) -> dict[str, bytes]:
    """The file, and what lies beside it."""
    beside = path.parent.glob("*.bin") if path.suffix == ".gltf" else ()
    return {part.name: part.read_bytes() for part in (path, *beside)}


def seen(node, oracle, path, out, take, rate):
    """What three.js makes of an animation: every vertex at so many frames a second, and what it is called."""
    command = [str(node), str(oracle), str(path), str(out), "--anim", str(take), "--fps", str(rate)]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    return np.load(f"{out}.positions.npy"), json.loads(Path(f"{out}.json").read_text())


@pytest.mark.parametrize(("name", "take", "seconds"), MODELS)
def test_three_js_sees_the_same_motion(shared, node, oracle, tmp_path, name, take, seconds):
    """Each clip has its name and its length, and moves every vertex as the take does from that second on."""
    path, rate = shared / "data" / name, RATES[name.partition("/")[0]]
    parts = parts_of(path)
    document = cut_at(opened(parts, take=take, fps=30), [30 * second for second in seconds])
    glb = clips_of(parts, document)
    (tmp_path / "clips.glb").write_bytes(glb)
    whole, said = seen(node, oracle, path, tmp_path / "take", take, rate)
    diagonal = np.linalg.norm(np.ptp(whole, axis=(0, 1)))
    ends = [*seconds, said["duration"]]
    for number, start, end in zip(range(len(ends)), [0, *seconds], ends, strict=True):
        clip, called = seen(node, oracle, tmp_path / "clips.glb", tmp_path / "clip", take + number, rate)
        assert called["name"] == names_of(glb)[take + number]
        assert called["duration"] == pytest.approx(end - start, abs=1e-5)
        expected = whole[start * rate :][: len(clip)]
        assert np.abs(clip[: len(expected)] - expected).max() <= CLOSE * diagonal


@pytest.mark.parametrize(
    ("name", "fps"),
    [("fox_hard_0", 30), ("fox_hard_0", 25), ("godotman_hard_1", 30), ("godotman_hard_1", 25), ("ybot_hard_0", 30)],
)
def test_long_takes_hardly_grow(shared, name, fps):
    """Cut where their motions really change, on keys and between them: the same motion, at most 1.1 times as large."""
    path = shared / "data" / "takes" / f"{name}.glb"
    data, truth = path.read_bytes(), json.loads(path.with_suffix(".truth.json").read_text())
    cuts = [int(segment["start"] * fps / truth["fps"]) for segment in truth["segments"][1:]]
    take = opened(data, fps=fps)
    document = cut_at(take, cuts)
    glb = clips_of(data, document)
    assert len(glb) <= 1.1 * len(data)
    assert worst_miss(take, glb, document) <= CLOSE


@pytest.mark.parametrize("name", ["draco", "quantized", "sparse", "meshopt_high", "meshopt_medium"])
def test_packed_files_grow_by_their_json_alone(shared, name):
    """Cut on keys, clips lie in the file's own bytes, even compressed ones: new are their times and what names them."""
    data = (shared / "data/gltf/variants" / f"Fox_{name}.glb").read_bytes()
    take = opened(data)
    cuts = [take.frames // 4, take.frames // 2]
    glb = clips_of(data, cut_at(take, cuts))
    before, after = chunks_of(data), chunks_of(glb)
    channels = len(before[0]["animations"][take.take.index]["channels"])
    assert len(after[1]) <= len(before[1]) + 250 * len(cuts)
    assert len(glb) - len(data) <= (200 * channels + 400) * len(cuts)


@pytest.mark.parametrize(
    ("name", "most"),
    [("draco", 1.1), ("quantized", 1.1), ("sparse", 1.1), ("meshopt_medium", 1.8), ("meshopt_high", 2.7)],
)
def test_packed_files_cut_between_keys(shared, name, most):
    """Their binary data hardly grows; beside a compressed stream that other takes share, new keys are plain floats."""
    data = (shared / "data/gltf/variants" / f"Fox_{name}.glb").read_bytes()
    take = opened(data, fps=29)
    document = cut_at(take, [take.frames // 4, take.frames // 2])
    glb = clips_of(data, document)
    assert len(chunks_of(glb)[1]) <= most * len(chunks_of(data)[1])
    assert worst_miss(take, glb, document) <= CLOSE


def test_three_js_reads_new_keys_beside_streams(shared, node, oracle, tmp_path):
    """Every vertex of every clip, and of the takes that stay in their streams."""
    path = shared / "data/gltf/variants/Fox_meshopt_medium.glb"
    document = cut_at(opened(path.read_bytes(), fps=29), [21, 48])
    (tmp_path / "clips.glb").write_bytes(clips_of(path.read_bytes(), document))
    starts = [0, 21, 48, 0, 0]
    for number, (start, take) in enumerate(zip(starts, [0, 0, 0, 1, 2], strict=True)):
        whole, _ = seen(node, oracle, path, tmp_path / "take", take, 58)
        clip, _ = seen(node, oracle, tmp_path / "clips.glb", tmp_path / "clip", number, 58)
        expected = whole[2 * start :][: len(clip)]
        diagonal = np.linalg.norm(np.ptp(whole, axis=(0, 1)))
        assert np.abs(clip[: len(expected)] - expected).max() <= CLOSE * diagonal


def test_morphs_of_many_targets_stay_sparse(shared):
    """Horse's targets are sparse: their accessors and bytes are those of the file."""
    data = (shared / "data/gltf/Horse.glb").read_bytes()
    before, old = chunks_of(data)
    after, new = chunks_of(clips_of(data, cut_at(opened(data), [12])))
    targets = [n for mesh in before["meshes"] for p in mesh["primitives"] for t in p["targets"] for n in t.values()]
    assert any("sparse" in before["accessors"][number] for number in targets)
    for number in targets:
        assert after["accessors"][number] == before["accessors"][number]
    assert abs(len(new) - len(old)) < 1000
