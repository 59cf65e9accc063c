"""Every shared model, against three.js: an independent reader of glTF, run in Node."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import read_animation

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
    ("variants/Fox_meshopt_medium.glb", 3, 5e-5),
    ("variants/Fox_meshopt_high.glb", 3, 5e-5),
    ("variants/Fox_sparse.glb", 3, 1e-6),
    ("variants/Fox_quantized.glb", 3, 5e-5),
]


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
