"""Many takes at once: all are posted as fast as they are taken, and everything is watched until the last is done."""

import json
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from statistics import median
from urllib.parse import urlsplit

from benchmarks.load.calls import Calls
from benchmarks.load.measure import Measure, percentile
from benchmarks.load.takes import different
from benchmarks.timing.processes import Running, descendants, role
from caesura.samples.long_session import long_session
from caesura.samples.performed_take import RATE

SMALL, LARGE = 300, 9_000
"""Frames: ten seconds, five minutes."""
POSTERS = 4
LOOK_SECONDS = 0.5
PAUSE_SECONDS = 0.02
LONGEST_SECONDS = 3 * 3600.0
FLAT = 1.15


class Memory:
    """Resident bytes by role, looked at twice a second."""

    def __init__(self, root: int) -> None:
        self._root = root
        self._seen: dict[str, list[int]] = {}
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def stop(self) -> dict[str, list[int]]:
        """All that was seen, in order."""
        self._over.set()
        self._thread.join()
        return self._seen

    def _look(self) -> None:
        while not self._over.wait(LOOK_SECONDS):
            together: dict[str, int] = {}
            for pid in descendants(self._root):
                together[role(pid)] = together.get(role(pid), 0) + _resident(pid)
            for name, size in together.items():
                self._seen.setdefault(name, []).append(size)


def crowd(running: Running, small: int, large: int) -> list[Measure]:
    """Post `small` short takes and `large` long ones; how long it takes, how much memory, how fast others are read."""
    with Calls(running.url) as calls:
        first = calls.post_file(next(different(long_session(SMALL + 1).glb)))["id"]
        memory, since = Memory(running.pid), time.perf_counter()
        with polled(running.url, f"/v1/segmentations/{first}") as took:
            with ThreadPoolExecutor(POSTERS) as pool:
                posted = list(pool.map(lambda glb: _post(running.url, glb), _mixed(small, large)))
            accepted = time.perf_counter() - since
            done = sum(calls.ended(identifier)["status"] == "done" for identifier in posted)
            seconds = time.perf_counter() - since
        seen = memory.stop()
    motion = (small * SMALL + large * LARGE) / RATE
    return [
        Measure("takes posted", small + large),
        Measure("takes done", done, least=small + large),
        Measure("all accepted after", accepted, "s"),
        Measure("all done after", seconds, "s"),
        Measure("takes an hour, one worker on `analyse`", done / seconds * 3600),
        Measure("hours of motion an hour, one worker on `analyse`", motion / seconds),
        Measure("status reads meanwhile, p50", percentile(took, 0.5), "ms"),
        Measure("status reads meanwhile, p99", percentile(took, 0.99), "ms", most=25),
        *_memories(seen),
    ]


def _memories(seen: dict[str, list[int]]) -> Iterator[Measure]:
    """The last quarter beside the second one. What Redis holds more are the results."""
    for name, sizes in sorted(seen.items()):
        quarter = max(len(sizes) // 4, 1)
        before, after = median(sizes[quarter : 2 * quarter] or sizes), median(sizes[-quarter:])
        bound = None if name == "Redis" else FLAT
        yield Measure(f"memory of {name} at the end", after / 2**20, "MB")
        yield Measure(f"the same, over what it was after a quarter of the time: {name}", after / before, most=bound)


def _mixed(small: int, large: int) -> Iterator[bytes]:
    """Different files, the long ones evenly among the short."""
    short, long = different(long_session(SMALL).glb), different(long_session(LARGE).glb)
    every = max(small // max(large, 1), 1)
    for number in range(max(small, large * every)):
        if number < small:
            yield next(short)
        if number % every == 0 and number // every < large:
            yield from islice(long, 1)


def _post(url: str, glb: bytes) -> str:
    with Calls(url) as calls:
        identifier: str = calls.post_file(glb, wait=False)["id"]
        return identifier


@contextmanager
def polled(url: str, path: str) -> Iterator[list[float]]:
    """A process of its own reads one path fifty times a second; its milliseconds are in the list afterwards."""
    place = urlsplit(url)
    command = [sys.executable, "-m", "benchmarks.load.reader", str(place.hostname), str(place.port), path]
    command += [str(LONGEST_SECONDS), str(PAUSE_SECONDS)]
    client = subprocess.Popen(command, stdout=subprocess.PIPE)
    took: list[float] = []
    try:
        yield took
    finally:
        client.terminate()
        told, _ = client.communicate()
        took += json.loads(told)


def _resident(pid: int) -> int:
    try:
        pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    except OSError:
        return 0  # it has ended since
    return pages * 4096
