"""Broken files of every input format, sent to a running service with its workers.

    python -m benchmarks.attack.mutants ../shared/data/formats            # 2,000 of each format: hours
    python -m benchmarks.attack.mutants --count 20 --formats bvh,c3d      # of the project's own files alone

The files below FILES and those that the fuzzer begins with are changed as `make fuzz` changes them, uploaded, asked to
be cut, and deleted again. What a file's answer must not be: a status 500, a job that failed by a fault of ours or lost
its worker, a job beyond its time, or none. A file that did it is kept in `.fuzz`. Ends with status 1 where there was
one, where the web process grew beyond its bound, or where it is another process than before.
"""

import argparse
import hashlib
import random
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from datetime import datetime
from itertools import islice
from pathlib import Path
from typing import Any

import httpx

from benchmarks.timing.processes import Watch, descendants, role, service
from caesura.core.errors import CaesuraError
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.input_formats import INPUT_FORMATS
from tests.fuzz import native
from tests.fuzz.mutations import mutated
from tests.fuzz.parts import joined, parted
from tests.fuzz.seeds import seeds

FOLDER = Path(".fuzz")
LARGEST = 2**20
"""Bytes of a file below FILES; larger ones are left out, for faults are in structure and not in size."""
READER_SECONDS, JOB_SECONDS, READER_BYTES, JOB_BYTES = 10, 30, 2**29, 2**30
PATIENCE_SECONDS = 300.0
"""Until an answer must have come, however many wait."""
WEB_BYTES = 400 * 2**20
SETTINGS = {
    "CAESURA_MAX_READER_SECONDS": READER_SECONDS, "CAESURA_MAX_READER_BYTES": READER_BYTES,
    "CAESURA_JOB_SECONDS": JOB_SECONDS, "CAESURA_JOB_MEMORY_BYTES": JOB_BYTES, "CAESURA_ATTEMPTS": 1,
    "CAESURA_MAX_FRAMES": 20_000, "CAESURA_MAX_NODE_FRAMES": 5_000_000, "CAESURA_MAX_TRIANGLE_FRAMES": 20_000_000,
}  # fmt: skip
ASKED = ({"end": 1.0}, {"take": "all", "end": 1.0}, {"fps": 15, "end": 2.0}, {"motions": 2, "end": 1.0, "trim": True})
FAULTS = {"internal-error", "worker-killed", "worker-lost", "storage-unavailable"}
NATIVE = {"fbx", "abc", "usd"}


@dataclass
class Outcome:
    """What became of the files of one format."""

    answers: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    faults: int = 0


def main() -> int:
    """Send, and tell; 1 where something was found."""
    arguments = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    arguments.add_argument("files", type=Path, nargs="?", help="a folder with more files to change")
    arguments.add_argument("--count", type=int, default=2000, help="files of each format")
    arguments.add_argument("--formats", default=",".join(INPUT_FORMATS))
    arguments.add_argument("--at-once", type=int, default=4)
    arguments.add_argument("--seed", type=int, default=int(time.time()) % 2**31)
    chosen = arguments.parse_args()
    beginnings = find_beginnings(chosen.files)
    with service(**{name: str(value) for name, value in SETTINGS.items()}) as running:
        web = _web_process(running.pid)
        watch = Watch(running.pid)
        faults = 0
        for name in chosen.formats.split(","):
            began = time.monotonic()
            found = attack(running.url, name, beginnings.get(name, []), chosen.count, chosen.seed, chosen.at_once)
            faults += found.faults
            listed = ", ".join(f"{number} {code}" for code, number in found.answers.most_common(12))
            print(
                f"{name}: {sum(found.answers.values()):,} files of {len(beginnings.get(name, []))} in "
                f"{time.monotonic() - began:,.0f} s: {listed}. The slowest job took {found.slowest:.1f} s.",
                flush=True,
            )
        same = web == _web_process(running.pid)
        peaks = watch.stop()
        log = (running.redis.parent.parent / "log").read_text(errors="replace")
    sizes = ", ".join(f"{name} {size / 2**20:,.0f} MB" for name, size in sorted(peaks.items()))
    print(f"seed {chosen.seed}; largest resident sizes: {sizes}; {log.count('Traceback')} tracebacks in the log")
    if faults or "Traceback" in log:
        FOLDER.mkdir(exist_ok=True)
        (FOLDER / "mutants.log").write_text(log)
    return int(faults > 0 or not same or peaks["web"] > WEB_BYTES)


def find_beginnings(folder: Path | None) -> dict[str, list[bytes]]:
    """Uploads to change, by the format of their first readable file."""
    found: dict[str, list[bytes]] = {}
    uploads = [*seeds(), *(data for kind in NATIVE for data in _native_seeds(kind)), *_files(folder)]
    for data in dict.fromkeys(uploads):
        name = _format(data)
        if name is not None:
            found.setdefault(name, []).append(data)
    return found


def _native_seeds(kind: str) -> Iterator[bytes]:
    try:
        yield from native.seeds(kind)
    except ImportError:
        return


def _files(folder: Path | None) -> Iterator[bytes]:
    """Those of a folder, a companion with each that needs one: a mesh beside its points."""
    for path in sorted(folder.rglob("*")) if folder else ():
        if not path.is_file() or path.stat().st_size > LARGEST or path.suffix in {".obj", ".json", ".md"}:
            continue
        mesh = path.with_name(f"{path.stem}_base.obj")
        beside = {mesh.name: mesh.read_bytes()} if path.suffix in {".pc2", ".mdd"} and mesh.exists() else {}
        yield joined({path.name: path.read_bytes(), **beside}) if beside else path.read_bytes()


def _format(data: bytes) -> str | None:
    kinds = set()
    for part in parted(data).values():
        try:
            kinds.add(detect_file_type(part[:SIGNATURE_BYTES]))
        except CaesuraError:
            continue
    return next(iter(sorted(kinds)), None)


def attack(url: str, name: str, beginnings: list[bytes], count: int, seed: int, at_once: int) -> Outcome:
    """Send so many files of one format, some at once."""
    found, draw = Outcome(), random.Random(f"{name} {seed}")
    if not beginnings:
        return found
    largest = max(map(len, beginnings)) + 4096
    change = native.mutant if name in NATIVE else lambda data, draw: mutated(data, draw, largest)
    mutants = ((change(draw.choice(beginnings), draw), dict(draw.choice(ASKED))) for _ in range(count))
    with httpx.Client(base_url=url, timeout=PATIENCE_SECONDS, trust_env=False) as http:

        def one(made: tuple[bytes, Mapping[str, Any]]) -> None:
            data, asked = made
            try:
                code, seconds = send(http, name, data, asked)
            except (httpx.HTTPError, TimeoutError) as fault:
                code, seconds = f"FAULT {type(fault).__name__}", 0.0
            if code.startswith("FAULT") or seconds > JOB_SECONDS + READER_SECONDS:
                found.faults += 1
                FOLDER.mkdir(exist_ok=True)
                kept = FOLDER / f"found-{name}-{hashlib.sha256(data).hexdigest()[:12]}"
                kept.write_bytes(data)
                print(f"FOUND {code} after {seconds:.0f} s, {dict(asked)}: {kept}", flush=True)
            found.answers[code] += 1
            found.slowest = max(found.slowest, seconds)

        with ThreadPoolExecutor(at_once) as several:
            while some := list(islice(mutants, 16 * at_once)):
                for _ in several.map(one, some):
                    pass
    return found


def send(http: httpx.Client, name: str, data: bytes, asked: Mapping[str, Any]) -> tuple[str, float]:
    """What a file was answered, by its code, and how many seconds its job took; it is deleted again."""
    parts = parted(data)
    body: dict[str, Any] = (
        {"content": data, "headers": {"Content-Type": "application/octet-stream"}}
        if len(parts) == 1
        else {"files": [("file", (called or "x", part)) for called, part in parts.items()]}
    )
    answer = http.post("/v1/segmentations", params={**asked, "name": f"mutant.{name}"}, **body)
    said = answer.json()
    if answer.status_code >= 400:
        return ("FAULT 500" if answer.status_code >= 500 else said["code"]), 0.0
    deadline = time.monotonic() + PATIENCE_SECONDS
    while said["status"] in {"queued", "running"}:
        if time.monotonic() > deadline:
            raise TimeoutError
        said = http.get(f"/v1/segmentations/{said['id']}", headers={"Prefer": "wait=30"}).json()
    http.delete(f"/v1/animations/{said['animation']}").raise_for_status()
    began, ended = (datetime.fromisoformat(said[key]) if said[key] else None for key in ("started", "finished"))
    seconds = (ended - began).total_seconds() if began and ended else 0.0
    code = said["status"] if said["problem"] is None else said["problem"]["code"]
    return (f"FAULT {code}" if code in FAULTS else code), seconds


def _web_process(root: int) -> list[int]:
    return [pid for pid in descendants(root) if role(pid) == "web"]


if __name__ == "__main__":
    sys.exit(main())
