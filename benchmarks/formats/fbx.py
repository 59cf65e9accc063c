"""An FBX beside the same GLB: from the file to the answer of the command, in pairs.

`python -m benchmarks.formats.fbx` makes a figure of 28,000 vertices with 1,000 frames as an FBX in text, the slower
kind, and as the GLB that it is read as; or takes the FBX that it is given.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np

from caesura.core.limits import Limits
from caesura.formats.native.fbx.gltf_conversion import convert_fbx_to_glb
from tests.formats.native.fbx_text import FbxText

ROUND, BONES, RATE = 100, 50, 30


def main() -> None:
    """Measure, and print medians and their ratio."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("file", type=Path, nargs="?")
    arguments.add_argument("--vertices", type=int, default=28_000)
    arguments.add_argument("--frames", type=int, default=1_000)
    arguments.add_argument("--pairs", type=int, default=5)
    chosen = arguments.parse_args()
    data = chosen.file.read_bytes() if chosen.file else bending_tube(chosen.vertices, chosen.frames)
    with tempfile.TemporaryDirectory() as folder:
        fbx, glb = Path(folder) / "take.fbx", Path(folder) / "take.glb"
        fbx.write_bytes(data)
        glb.write_bytes(convert_fbx_to_glb(memoryview(data), Limits.none()).glb)
        print(f"FBX of {fbx.stat().st_size / 1e6:.1f} MB, GLB of {glb.stat().st_size / 1e6:.1f} MB")
        seconds = [[_seconds(path) for path in (fbx, glb)] for _ in range(chosen.pairs)]
    of_fbx, of_glb = (median(column) for column in zip(*seconds, strict=True))
    ratio = median(a / b for a, b in seconds)
    print(
        f"file to answer: FBX {of_fbx:.2f} s, GLB {of_glb:.2f} s, {ratio:.2f} times (medians of {chosen.pairs} pairs)"
    )


def _seconds(path: Path) -> float:
    began = time.perf_counter()
    subprocess.run(
        [Path(sys.executable).parent / "caesura", "segment", path, "--json"], check=True, capture_output=True
    )
    return time.perf_counter() - began


def bending_tube(vertices: int, frames: int) -> bytes:
    """A tube along a chain of bones, two for each vertex, that sways in one of three ways for 50 frames each."""
    made = FbxText(rate=RATE)
    rings = vertices // ROUND
    bones: list[int] = []
    for number in range(BONES):
        place = ("Lcl Translation", "Lcl Translation", 0, 10 if number else 0, 0)
        bones.append(made.model(f"bone {number}", place, parent=bones[-1] if bones else 0, subtype="LimbNode"))
    angle = np.arange(ROUND) / ROUND * 2 * np.pi
    height = np.repeat(np.arange(rings) / rings * 10 * BONES, ROUND)
    points = np.stack([np.tile(20 * np.cos(angle), rings), height, np.tile(20 * np.sin(angle), rings)], axis=1)
    ring, step = np.divmod(np.arange((rings - 1) * ROUND), ROUND)
    corner, beside = ring * ROUND + step, ring * ROUND + (step + 1) % ROUND
    polygons = np.stack([corner, corner + ROUND, beside + ROUND, beside], axis=1)
    geometry = made.mesh(points.round(3).tolist(), polygons.tolist(), made.model("tube", subtype="Mesh"))
    lower = np.minimum((height // 10).astype(int), BONES - 2)
    share = np.clip(height / 10 - lower, 0, 1)
    parts = []
    for number, bone in enumerate(bones):
        weight = np.where(lower == number, 1 - share, 0) + np.where(lower == number - 1, share, 0)
        used = np.flatnonzero(weight)
        parts.append((bone, used.tolist(), weight[used].round(4).tolist(), (0.0, 10.0 * number, 0.0)))
    made.skin(geometry, parts)
    at = np.arange(frames) / RATE
    way = (np.arange(frames) // 50) % 3
    layer = made.layer(made.stack("sway", 0, at[-1]))
    draw = np.random.default_rng(0)
    for bone in bones:
        curves = {}
        for axis in "xyz":
            size, speed, phase = draw.uniform(0, 6, 3), draw.uniform(3, 12, 3), draw.uniform(0, 6, 3)
            curves[axis] = (size[way] * np.sin(speed[way] * at + phase[way])).round(4).tolist()
        made.animate(layer, bone, "Lcl Rotation", at.tolist(), **curves)
    return made.data()


if __name__ == "__main__":
    main()
