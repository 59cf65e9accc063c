"""The importers of docs/engines do what their pages say, as far as it can be run without the engines."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from click.testing import CliRunner

from caesura.samples.sample_figures import build_figure
from caesura.service.commands.cli import main
from tests.conftest import unavailable

PLAY = """
import { readFileSync } from 'node:fs';
import { AnimationMixer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { playClip, prepareClips } from './caesura_clips.mjs';

globalThis.self = globalThis;
const data = readFileSync(process.argv[2]);
const gltf = await new GLTFLoader().parseAsync(new Uint8Array(data).buffer, '');
const clips = prepareClips(gltf.animations, JSON.parse(readFileSync(process.argv[3])));
const pose = () => {
  const all = [];
  gltf.scene.traverse(({ position, quaternion }) => all.push(...position.toArray(), ...quaternion.toArray()));
  return all;
};
const played = [...clips].map(([name, prepared]) => {
  const mixer = new AnimationMixer(gltf.scene);
  const action = playClip(mixer, prepared, 0);
  mixer.update(0);
  const first = pose();
  mixer.update(prepared.clip.duration / 2);
  const moved = Math.max(...pose().map((x, i) => Math.abs(x - first[i])));
  mixer.update(prepared.clip.duration);
  const { clip, ...rest } = prepared;
  return { name, ...rest, seconds: clip.duration, moved, running: action.isRunning(), clip: clip.name };
});
console.log(JSON.stringify(played));
"""


@pytest.fixture(scope="module")
def clips(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """clips.glb and clips.json beside it, by the command of the pages; motion A loops by its name, B by the result."""
    folder = tmp_path_factory.mktemp("engines")
    (folder / "take.glb").write_bytes(build_figure("rigid").glb)
    out = folder / "clips.glb"
    run = CliRunner().invoke(main, ["segment", str(folder / "take.glb"), "--clips", str(out), "--json", "--loop", "A"])
    assert run.exit_code == 0, run.output
    result = json.loads(run.stdout)
    for segment in result["segments"]:
        segment["loop"] = segment["name"] == "B"
    (folder / "clips.json").write_text(json.dumps(result))
    return out


def expected(clips: Path) -> list[dict[str, Any]]:
    count: dict[str, int] = {}
    found = []
    for segment in json.loads(clips.with_suffix(".json").read_text())["segments"]:
        count[segment["name"]] = count.get(segment["name"], 0) + 1
        name = f"{segment['name']}_{count[segment['name']]:02}"
        found.append({**segment, "name": name, "motion": segment["name"], "loop": segment["name"] in {"A", "B"}})
    return found


def test_three_js_plays_the_clips_by_their_names_and_loops(
    checkout: Path, node: Path, clips: Path, tmp_path: Path
) -> None:
    """The project's own three.js, in Node: a loop runs on after its end, and another clip has stopped."""
    vendor = checkout / "service/static/vendor/three"
    if not (vendor / "three.module.js").is_file():
        unavailable("no three.js: make setup fetches it")
    package = tmp_path / "node_modules/three"
    package.parent.mkdir()
    package.mkdir()
    for name in ("three.module.js", "three.core.js", "addons"):
        (package / name).symlink_to(vendor / name)
    exports = {".": "./three.module.js", "./addons/*": "./addons/*"}
    (package / "package.json").write_text(json.dumps({"name": "three", "type": "module", "exports": exports}))
    (tmp_path / "caesura_clips.mjs").write_text((checkout / "docs/engines/caesura_clips.mjs").read_text())
    (tmp_path / "play.mjs").write_text(PLAY)
    command = [node, "--preserve-symlinks", "play.mjs", clips, clips.with_suffix(".json")]
    run = subprocess.run(command, cwd=tmp_path, check=False, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    played = json.loads(run.stdout)
    wanted = expected(clips)
    for one, segment in zip(played, wanted, strict=True):
        for key in ("name", "motion", "start", "end", "loop", "confidence"):
            assert one[key] == segment[key], key
        assert one["clip"] == one["name"]
        assert one["seconds"] == pytest.approx(segment["end_seconds"] - segment["start_seconds"], abs=0.05)
        assert one["moved"] > 1e-3
        assert one["running"] == one["loop"]
    assert {one["loop"] for one in played} == {True, False}


def test_unreal_s_importer_finds_every_clip(checkout: Path, clips: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What of it needs no editor: the clips of the GLB, their loops, and the assets that importers make of them."""
    monkeypatch.setitem(sys.modules, "unreal", ModuleType("unreal"))
    spec = importlib.util.spec_from_file_location("caesura_import", checkout / "docs/engines/caesura_import.py")
    assert spec is not None
    assert spec.loader is not None
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    found = script.read_clips(clips)
    wanted = expected(clips)
    assert [(name, clip["loop"], clip["start"]) for name, clip in found.items()] == [
        (one["name"], one["loop"], one["start"]) for one in wanted
    ]
    for asset in ("A_01", "A_01-loop", "clips_Anim_A_01_loop", "clips_A_01"):
        assert script.clip_of_asset(asset, found) == "A_01"
    assert script.clip_of_asset("Idle", found) is None
