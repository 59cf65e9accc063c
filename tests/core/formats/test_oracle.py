"""Every shared model, against three.js: an independent reader of glTF, run in Node."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from core.animation import Animation
from core.errors import InvalidModel
from core.formats.read import read_animation
from core.limits import Limits
from core.parameters import Parameters

# name, animations to compare, share of the bounding box's diagonal
MODELS = [
    ("Fox.glb", 3, 1e-6),
    ("CesiumMan.glb", 1, 1e-6),
    ("RiggedSimple.glb", 1, 1e-6),
    ("SimpleSkin.gltf", 1, 1e-6),
    ("Horse.glb", 1, 1e-6),
    ("MorphStressTest.gltf", 3, 1e-6),
    ("SimpleMorph.gltf", 1, 1e-6),
    ("AnimatedMorphCube/AnimatedMorphCube.gltf", 1, 1e-6),
    ("singleBlendshapeCube_sparse.glb", 1, 1e-6),
    ("InterpolationTest/InterpolationTest.gltf", 9, 1e-6),
    ("godotman.glb", 4, 1e-6),
    ("variants/Fox_plain.glb", 3, 1e-6),
    ("variants/Fox_separate.gltf", 3, 1e-6),
    ("variants/Fox_draco.glb", 3, 1e-6),
    ("variants/Fox_sparse.glb", 3, 1e-6),
    ("variants/Fox_quantized.glb", 3, 5e-5),
]
COMPRESSED = [
    "Fox_meshopt_medium.glb",
    "Fox_meshopt_high.glb",
    "BoxMeshopt.gltf",
]


@pytest.fixture(scope="session")
def oracle(shared: Path, node: Path, request: pytest.FixtureRequest) -> Path:
    """A copy of the oracle with its modules, kept between runs; `CAESURA_ORACLE` names one that is ready."""
    if ready := os.environ.get("CAESURA_ORACLE"):
        return Path(ready) / "oracle.mjs"
    folder = Path(request.config.cache.mkdir("gltf-oracle"))  # type: ignore[union-attr]
    if not (folder / "node_modules").is_dir():
        for file in ("oracle.mjs", "package.json", "package-lock.json"):
            shutil.copyfile(shared / "tools" / "gltf-oracle" / file, folder / file)
        done = subprocess.run(
            [*_npm(node), "ci", "--no-audit", "--no-fund"], cwd=folder, check=False, capture_output=True, timeout=200
        )
        if done.returncode:
            shutil.rmtree(folder / "node_modules", ignore_errors=True)
            message = f"npm ci of the oracle failed: {done.stderr.decode(errors='replace')[-300:]}"
            pytest.fail(message) if os.environ.get("CI") == "true" else pytest.skip(message)
    return folder / "oracle.mjs"


def _npm(node: Path) -> list[str]:
    script = node.parent.parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    return [str(node), str(script)] if script.is_file() else ["npm"]


def opened(path: Path, **parameters: object) -> Animation:
    """The file and what lies beside it, as one upload."""
    parts = {path.name: path.read_bytes()}
    if path.suffix == ".gltf":
        parts |= {part.name: part.read_bytes() for part in path.parent.glob("*.bin")}
    return read_animation(parts, Parameters.parse(parameters), Limits(), lambda size: memoryview(bytearray(size)))


@pytest.mark.parametrize(("name", "take", "tolerance"), [(n, t, e) for n, takes, e in MODELS for t in range(takes)])
def test_vertices_and_triangles_are_those_of_three_js(
    shared: Path, node: Path, oracle: Path, tmp_path: Path, name: str, take: int, tolerance: float
) -> None:
    """Sampled at 30 frames a second, every vertex is where three.js has it, and every triangle has its corners."""
    path, out = shared / "data" / "gltf" / name, tmp_path / "oracle"
    command = [str(node), str(oracle), str(path), str(out), "--anim", str(take), "--fps", "30"]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    expected = np.load(f"{out}.positions.npy")
    said = json.loads(Path(f"{out}.json").read_text())

    animation = opened(path, take=take, fps=30)
    actual = animation.vertices(0, animation.frames)

    assert (animation.frames, animation.vertex_count) == expected.shape[:2]
    assert animation.take.duration_seconds == pytest.approx(said["duration"], abs=1e-6)
    np.testing.assert_array_equal(animation.triangles, np.load(f"{out}.triangles.npy"))
    diagonal = np.linalg.norm(expected.max(axis=(0, 1)) - expected.min(axis=(0, 1)))
    assert np.abs(actual - expected).max() <= tolerance * diagonal
    half = animation.frames // 2
    np.testing.assert_array_equal(
        np.concatenate([animation.vertices(0, half), animation.vertices(half, len(actual))]), actual
    )


@pytest.mark.parametrize("name", COMPRESSED)
def test_compressed_geometry_is_refused_with_the_way_out(shared: Path, name: str) -> None:
    """What cannot be decoded is never guessed at: the refusal names the tool that decompresses it."""
    with pytest.raises(InvalidModel, match="gltf-transform copy") as refused:
        opened(shared / "data" / "gltf" / "variants" / name)
    assert refused.value.code == "unsupported-extension"
