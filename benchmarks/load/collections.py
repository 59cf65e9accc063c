"""A collection that grows: what it costs to add one take, to read, to name and to search, with up to 1,000 takes.

    python -m benchmarks.load.collections --print      # some minutes; writes nothing
    python -m benchmarks.load.collections              # writes the table of docs/performance.md

A service with its workers labels a few takes of 36 seconds. Copies of them, with numbers of their own in the store, are
put beside them, until there are 10, 100, 300 and 1,000 takes: 10 hours. Then one more take, which is analysed already,
is added through the API, and so on. Ends with status 1 where a bound is missed.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

from benchmarks.load.calls import JSON, WAIT, Calls
from benchmarks.load.takes import different
from benchmarks.reports.report import write_section
from benchmarks.timing.processes import Running, descendants, role, service
from caesura.samples.long_session import long_session
from caesura.worker.records import Records
from caesura.worker.records.collection_types import TakeRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.records.connection import connect
from caesura.worker.store.blobs import Blobs

DOCS = Path(__file__).resolve().parent.parent.parent / "docs" / "performance.md"
SIZES = (10, 100, 300, 1000)
FRAMES = 1080
FIRST = 3
MOST_SECONDS, MOST_GROWTH = 2.0, 64.0
MEGABYTE = 2**20
TURNS, SEARCHES = 3, 7


class Row(NamedTuple):
    """What it costs with so many takes: seconds, but for sizes in MB. The first search of a worker reads the takes."""

    takes: int
    added: float
    read: float
    listed: float
    named: float
    searched_first: float
    searched: float
    web: float
    redis: float
    store: float


def main() -> int:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    arguments.add_argument("--print", action="store_true", help="print only")
    arguments.add_argument("--sizes", default=",".join(map(str, SIZES)))
    chosen = arguments.parse_args()
    sizes = [int(size) for size in chosen.sizes.split(",")]
    with service(CAESURA_MAX_COLLECTION_TAKES="2000") as running, Calls(running.url) as calls:
        rows = measure(running, calls, sizes)
    text = table(rows)
    print(text)
    if not chosen.print:
        write_section(DOCS, "collections", text)
    return int(max(row.added for row in rows) > MOST_SECONDS or rows[-1].web - rows[0].web > MOST_GROWTH)


def measure(running: Running, calls: Calls, sizes: Sequence[int]) -> list[Row]:
    """A row for each size."""
    glbs = different(long_session(FRAMES).glb)
    uploads = [calls.post_file(glb)["animation"] for glb in islice(glbs, FIRST + TURNS * len(sizes))]
    made = _post(calls, "/v1/collections", name="growing", animations=uploads[:FIRST])
    here = f"/v1/collections/{made['id']}"
    _labelled(calls, here)
    records = Records(connect(f"unix://{running.redis}"))
    blobs = Blobs.open(str(running.redis.parent.parent / "blobs"), running.redis.parent.parent / "scratch")
    rest = iter(uploads[FIRST:])
    rows = []
    for size in sizes:
        _fill(records, blobs, made["id"], uploads[:FIRST], size)
        rows.append(_row(running, calls, here, size, list(islice(rest, TURNS)), uploads[0]))
        print(rows[-1], flush=True)
    return rows


def _fill(records: Records, blobs: Blobs, identifier: str, animations: Sequence[str], size: int) -> None:
    """Copies of takes, each with its own files, until there are so many."""
    originals = records.collections.takes(identifier, animations)
    present = len(records.collections.entries(identifier))
    copies: list[TakeRecord] = []
    for place, take in enumerate(originals):
        copies += _copies(blobs, take, [f"copy-{n}" for n in range(present, size) if n % len(originals) == place])
    for first in range(0, len(copies), 100):
        _add(records, identifier, copies[first : first + 100])


def _add(records: Records, identifier: str, copies: Sequence[TakeRecord]) -> None:
    records.collections.change(identifier, lambda record: CollectionChange(record, tuple(copies)))


def _copies(blobs: Blobs, take: TakeRecord, names: Sequence[str]) -> list[TakeRecord]:
    numbers = take.numbers
    assert numbers is not None
    assert numbers.signatures is not None
    assert numbers.searched is not None
    parts = {"poses": numbers.poses, "signatures": numbers.signatures, "searched": numbers.searched}
    kept = {part: blobs.put_all([blobs.read(key)] * len(names), "collections") for part, key in parts.items()}
    copies = []
    for place, name in enumerate(names):
        own = numbers.model_copy(update={part: keys[place] for part, keys in kept.items()})
        copies.append(take.model_copy(update={"animation": name, "added": time.time(), "numbers": own}))
    return copies


def _row(running: Running, calls: Calls, here: str, size: int, fresh: Sequence[str], example: str) -> Row:
    adding = []
    for animation in fresh:
        began = time.perf_counter()
        _post(calls, f"{here}/takes", animations=[animation])
        _labelled(calls, here)
        adding.append(time.perf_counter() - began)
    motion = calls.http.get(here).json()["motions"][0]["id"]
    searching = []
    for _ in range(SEARCHES):
        began = time.perf_counter()
        found = _post(calls, f"{here}/searches", animation=example, start=0, end=90)
        while found["status"] == "working":
            found = calls.http.get(found["links"]["self"], headers=WAIT).json()
        searching.append(time.perf_counter() - began)
        if found["status"] != "done":
            raise RuntimeError(f"a search failed: {found['problem']}")
    data = running.redis.parent.parent
    stored = sum(path.stat().st_size for path in (data / "blobs" / "collections").iterdir())
    sizes = _sizes(running.pid)
    return Row(
        size,
        _median(adding),
        _seconds(calls, "GET", here),
        _seconds(calls, "GET", f"{here}/takes?limit=100"),
        _seconds(calls, "PATCH", f"{here}/motions/{motion}", json={"name": f"name {size}"}),
        max(searching),
        _median(searching),
        sizes["web"],
        sizes["Redis"],
        stored / MEGABYTE,
    )


def _labelled(calls: Calls, here: str) -> None:
    while (document := calls.http.get(here, headers=WAIT).json())["status"] == "working":
        continue
    if document["failed"]:
        raise RuntimeError(f"{document['failed']} takes failed")


def _post(calls: Calls, path: str, **body: Any) -> dict[str, Any]:
    answer = calls.http.post(path, json=body, headers=JSON)
    answer.raise_for_status()
    made: dict[str, Any] = answer.json()
    return made


def _seconds(calls: Calls, method: str, path: str, **request: Any) -> float:
    """The median of several."""
    took = []
    for _ in range(7):
        began = time.perf_counter()
        calls.http.request(method, path, **request).raise_for_status()
        took.append(time.perf_counter() - began)
    return _median(took)


def _median(values: Sequence[float]) -> float:
    return sorted(values)[len(values) // 2]


def _sizes(root: int) -> dict[str, float]:
    """MB of memory in use now, by role."""
    found: dict[str, float] = {}
    for pid in descendants(root):
        try:
            status = Path(f"/proc/{pid}/status").read_text()
        except OSError:
            continue
        resident = next((int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")), 0)
        found[role(pid)] = found.get(role(pid), 0.0) + resident / 1024
    return found


def table(rows: Sequence[Row]) -> str:
    """As Markdown."""
    head = (
        "| takes | one added | read | 100 takes listed | a motion named | searched first | searched | web process | "
        "Redis | store |"
    )
    lines = [
        f"| {row.takes:,} | {row.added:.2f} s | {1000 * row.read:.0f} ms | {1000 * row.listed:.0f} ms | "
        f"{1000 * row.named:.0f} ms | {row.searched_first:.2f} s | {1000 * row.searched:.0f} ms | {row.web:.0f} MB | "
        f"{row.redis:.0f} MB | {row.store:.0f} MB |"
        for row in rows
    ]
    return "\n".join([head, "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|", *lines])


if __name__ == "__main__":
    sys.exit(main())
