"""The first joint cut of a collection through the service: up to 1,000 takes that are given at once.

    python -m benchmarks.load.joint_cut --print      # some minutes; writes nothing
    python -m benchmarks.load.joint_cut              # writes the table of docs/performance.md

A service analyses a few takes of 36 seconds, each of other performances. Copies of their records stand for the other
takes, with the same files: every take is read, measured and cut as if it were one of its own, but not analysed.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from redis import Redis

from benchmarks.load.calls import JSON, WAIT, Calls
from benchmarks.reports.report import write_section
from benchmarks.timing.processes import Running, Watch, service
from caesura.core.parameters import ALGORITHM, Parameters
from caesura.samples.figure_glb import smooth_glb
from caesura.samples.long_session import plan_session
from caesura.samples.performed_take import perform_take
from caesura.samples.smooth_body import build_body
from caesura.worker.records import Records, content_ids, redis_keys
from caesura.worker.records.connection import connect

DOCS = Path(__file__).resolve().parent.parent.parent / "docs" / "performance.md"
SIZES = (10, 100, 300, 1000)
FRAMES = 1080
ORIGINALS = 8
MEGABYTE = 2**20


class Row(NamedTuple):
    """What the first cut of so many takes costs: seconds, the most memory of a process in MB, and what is found."""

    takes: int
    posted: float
    ready: float
    worker: float
    web: float
    segments: int
    motions: int


def main() -> int:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    arguments.add_argument("--print", action="store_true", help="print only")
    arguments.add_argument("--sizes", default=",".join(map(str, SIZES)))
    chosen = arguments.parse_args()
    sizes = [int(size) for size in chosen.sizes.split(",")]
    with service() as running, Calls(running.url) as calls:
        text = table(measure(running, calls, sizes))
    print(text)
    if not chosen.print:
        write_section(DOCS, "joint-cut", text)
    return 0


def measure(running: Running, calls: Calls, sizes: Sequence[int]) -> list[Row]:
    """A row for each size."""
    client = connect(f"unix://{running.redis}")
    originals = [calls.post_file(glb)["animation"] for glb in performances(ORIGINALS)]
    animations = originals + copies(client, originals, max(sizes) - ORIGINALS)
    rows = []
    for size in sizes:
        rows.append(_row(running, calls, animations[:size]))
        print(rows[-1], flush=True)
    return rows


def performances(count: int, frames: int = FRAMES) -> list[bytes]:
    """Takes of one body, each of other motions."""
    body = build_body()
    made = []
    for seed in range(count):
        random = np.random.default_rng(seed)
        made.append(smooth_glb(body, perform_take(plan_session(frames, random), random)))
    return made


def copies(client: Redis, animations: Sequence[str], count: int) -> list[str]:
    """So many animations more, each with the files and the result of one that is there."""
    records, secret = Records(client), content_ids.installation_secret(client)
    made = []
    for place in range(count):
        original = records.animations.one(animations[place % len(animations)])
        assert original is not None
        result = records.segmentations.of(original.id)[0]
        animation = original.model_copy(update={"id": f"{place:026d}", "name": f"copy {place}"})
        records.animations.add(animation, records.animations.takes(original))
        parameters = Parameters.model_validate(result.parameters)
        identifier = content_ids.segmentation_id(secret, animation.id, parameters.canonical(), ALGORITHM)
        segmentation = result.model_copy(update={"id": identifier, "animation": animation.id})
        records.segmentations.change(identifier, lambda one: one, new=segmentation)
        for part in ("document", "energy", "labels"):
            client.copy(redis_keys.segmentation_key(result.id, part), redis_keys.segmentation_key(identifier, part))
        made.append(animation.id)
    return made


def _row(running: Running, calls: Calls, animations: Sequence[str]) -> Row:
    watch = Watch(running.pid)
    began = time.perf_counter()
    asked = {"name": f"{len(animations)} takes", "animations": list(animations)}
    answer = calls.http.post("/v1/collections", json=asked, headers=JSON)
    answer.raise_for_status()
    posted = time.perf_counter() - began
    here = f"/v1/collections/{answer.json()['id']}"
    while (document := calls.http.get(here, headers=WAIT).json())["status"] == "working":
        continue
    ready = time.perf_counter() - began
    peaks = watch.stop()
    if document["failed"]:
        raise RuntimeError(f"{document['failed']} takes failed")
    motions = document["motions"]
    return Row(
        len(animations),
        posted,
        ready,
        peaks["worker"] / MEGABYTE,
        peaks["web"] / MEGABYTE,
        sum(motion["segments"] for motion in motions),
        len(motions),
    )


def table(rows: Sequence[Row]) -> str:
    """As Markdown."""
    head = "| takes | asked for | labelled | a worker at most | web process at most | segments | motions |"
    lines = [
        f"| {row.takes:,} | {row.posted:.2f} s | {row.ready:.1f} s | {row.worker:.0f} MB | {row.web:.0f} MB | "
        f"{row.segments:,} | {row.motions} |"
        for row in rows
    ]
    return "\n".join([head, "|---|---:|---:|---:|---:|---:|---:|", *lines])


if __name__ == "__main__":
    sys.exit(main())
