"""Clips are valid glTF by Khronos' own validator, with no fault that the source has not."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tests.formats.clips.making import clips_of, cut_at, key_poses_of
from tests.formats.opening import opened
from tests.glb import Glb, bending_strip

SCRIPT = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])), { maxIssues: 100000 })
  .then((report) => console.log(JSON.stringify(report.issues.messages.filter((m) => m.severity < 2))));
"""


@pytest.fixture(scope="session")
def faults(checkout, node, request):
    """Says the errors and warnings in a GLB, as sentences."""
    folder = Path(request.config.cache.mkdir("gltf-validator"))
    if not (folder / "node_modules" / "gltf-validator").is_dir():
        for file in ("package.json", "package-lock.json"):
            shutil.copyfile(checkout / file, folder / file)
        script = node.parent.parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
        npm = [str(node), str(script)] if script.is_file() else ["npm"]
        done = subprocess.run(
            [*npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund"],
            check=False, cwd=folder, capture_output=True, timeout=200,
        )  # fmt: skip
        if done.returncode:
            message = f"npm ci of the validator failed: {done.stderr.decode(errors='replace')[-300:]}"
            pytest.fail(message) if os.environ.get("CI") == "true" else pytest.skip(message)

    def validate(glb: bytes) -> list[str]:
        path = folder / "checked.glb"
        path.write_bytes(glb)
        run = subprocess.run(
            [str(node), "-e", SCRIPT, str(path)], check=True, cwd=folder, capture_output=True, timeout=60
        )
        return [f"{issue['code']} {issue.get('pointer', '')}: {issue['message']}" for issue in json.loads(run.stdout)]

    return validate


def nodding(interpolation: str) -> Glb:
    """The bending strip with turns of 90°, so that a spline between its keys leaves the unit sphere by far."""
    model, half = bending_strip(), np.sqrt(0.5)
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    keys = np.array([[0, 0, 0, 1], [0, 0, half, half], [0, half, 0, half], [0, 0, 0, 1]])
    widths = np.array([0, 1, 0.5, 0])
    if interpolation == "CUBICSPLINE":
        keys = np.stack([keys * 0, keys, keys * 0], axis=1).reshape(-1, 4)
        widths = np.stack([widths * 0 + 1, widths, widths * 0 - 1], axis=1).reshape(-1)
    model.animate(2, "rotation", [0, 1, 2, 3], keys, interpolation)
    model.animate(0, "weights", [0, 1, 2, 3], widths, interpolation)
    for accessor in model.json["accessors"]:
        if accessor["type"] == "SCALAR" and accessor["count"] == 4 and accessor["componentType"] == 5126:
            accessor |= {"min": [0], "max": [3]}
    for primitive in (p for mesh in model.json["meshes"] for p in mesh["primitives"]):
        for attributes in (primitive["attributes"], *primitive["targets"]):
            model.json["accessors"][attributes["POSITION"]] |= {"min": [0, 0, 0], "max": [1, 2, 0]}
    model.json["accessors"][primitive["targets"][0]["POSITION"]] |= {"min": [0, 0, 0], "max": [1, 0, 0]}
    return model


@pytest.mark.parametrize("interpolation", ["LINEAR", "STEP", "CUBICSPLINE"])
def test_clips_are_valid(faults, interpolation):
    """Cut on keys and between them, with the take kept, alone, and as key poses: nothing is wrong that was not."""
    data = nodding(interpolation).glb()
    document = cut_at(opened(data, fps=30), [17, 30, 44])
    before = {fault.split()[0] for fault in faults(data)}
    for options in ({}, {"keep_source": True}, {"animation_only": True}, {"origin": "keep", "handles_seconds": 0.1}):
        found = faults(clips_of(data, document, **options))
        assert [fault for fault in found if fault.split()[0] not in before] == []
    assert [fault for fault in faults(key_poses_of(data, document)) if fault.split()[0] not in before] == []


@pytest.mark.parametrize("interpolation", ["LINEAR", "CUBICSPLINE"])
def test_a_clip_of_the_last_frame_is_valid(faults, interpolation):
    """A person may cut before it: one pose, and no two keys at one time, whether it moved until then or not."""
    data = nodding(interpolation).glb()
    take = opened(data, fps=30)
    before = {fault.split()[0] for fault in faults(data)}
    for cuts in ([take.frames - 1], [*range(1, take.frames, 9), take.frames - 1]):
        found = faults(clips_of(data, cut_at(take, cuts)))
        assert [fault for fault in found if fault.split()[0] not in before] == []


@pytest.mark.parametrize("name", ["Fox.glb", "CesiumMan.glb", "Horse.glb", "godotman.glb"])
def test_clips_of_models_are_valid(shared, faults, name):
    """Models that people share, cut in three."""
    data = (shared / "data" / "gltf" / name).read_bytes()
    take = opened(data)
    before = {fault.split()[0] for fault in faults(data)}
    glb = clips_of(data, cut_at(take, [take.frames // 3, take.frames // 2]))
    assert [fault for fault in faults(glb) if fault.split()[0] not in before] == []
    assert len(glb) <= 1.1 * len(data)


@pytest.mark.parametrize("name", ["draco", "quantized", "sparse", "meshopt_medium", "meshopt_high"])
def test_clips_of_packed_files_are_valid(shared, faults, name):
    """Cut between keys: new ones lie beside what is compressed."""
    data = (shared / "data/gltf/variants" / f"Fox_{name}.glb").read_bytes()
    glb = clips_of(data, cut_at(opened(data, fps=29), [21, 48]))
    assert faults(data) == faults(glb) == []
