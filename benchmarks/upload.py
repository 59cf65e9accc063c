"""A large upload must not cost the web process memory: `python -m benchmarks.upload [--gigabytes 1.5]`.

Makes a vertex sequence of that size on disk, posts it raw and as multipart to a service of its own, and writes the most
memory the web process had into docs/performance.md. `--print` writes nothing.
"""

import argparse
import time
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx
import numpy as np

from benchmarks.reports.report import write_section
from benchmarks.timing.processes import Watch, service

DOCS = Path(__file__).resolve().parent.parent / "docs" / "performance.md"
VERTICES = 40_000
FRAMES_AT_ONCE = 100


def main() -> None:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--gigabytes", type=float, default=1.5)
    arguments.add_argument("--print", action="store_true", help="print only")
    chosen = arguments.parse_args()
    with TemporaryDirectory(prefix="caesura-bench-") as folder:
        file = Path(folder) / "sequence.npz"
        write_sequence(file, round(chosen.gigabytes * 1e9 / (VERTICES * 12)))
        rows = [_posted(file, way) for way in ("raw", "multipart")]
    text = "\n".join(
        ["| body | bytes | seconds | largest resident size of the web process |", "|---|---|---|---|", *rows]
    )
    print(text)
    if not chosen.print:
        write_section(DOCS, "upload", text)


def write_sequence(file: Path, frames: int) -> None:
    """A stored NPZ of a strip that waves, written a hundred frames at a time."""
    header = {"descr": "<f4", "fortran_order": False, "shape": (frames, VERTICES, 3)}
    x = np.linspace(0, 1, VERTICES // 2).repeat(2)
    side = np.tile([0.0, 0.01], VERTICES // 2)
    first = np.arange(0, VERTICES - 2, 2)
    triangles = np.concatenate(
        [np.stack([first, first + 1, first + 2], 1), np.stack([first + 1, first + 3, first + 2], 1)]
    )
    with zipfile.ZipFile(file, "w") as archive:
        with archive.open("vertices.npy", "w", force_zip64=True) as member:
            np.lib.format.write_array_header_1_0(member, header)
            for start in range(0, frames, FRAMES_AT_ONCE):
                time_ = np.arange(start, min(start + FRAMES_AT_ONCE, frames))[:, None] / 30
                height = 0.1 * np.sin(9 * x + time_)
                block = np.stack([np.broadcast_to(x, height.shape), height, np.broadcast_to(side, height.shape)], 2)
                member.write(block.astype("<f4").tobytes())
        with archive.open("triangles.npy", "w") as member:
            np.lib.format.write_array(member, triangles.astype(np.int32))


def _posted(file: Path, way: str) -> str:
    """One row: the file posted one way to a fresh service."""
    with service() as (url, pid, _), file.open("rb") as body, httpx.Client(timeout=600, trust_env=False) as http:
        watch = Watch(pid)
        since = time.perf_counter()
        address = f"{url}/v1/animations"
        sent = {"content": body} if way == "raw" else {"files": {"file": ("sequence.npz", body)}}
        answer = http.post(address, **sent)
        seconds = time.perf_counter() - since
        peak = watch.stop()["web"]
    answer.raise_for_status()
    return f"| {way} | {file.stat().st_size:,} | {seconds:.1f} | {peak / 2**20:,.0f} MB |"


if __name__ == "__main__":
    main()
