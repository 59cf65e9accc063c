"""The process that files are tried in: guided by coverage where atheris can be had, else blindly. Ends at a fault."""

import faulthandler
import hashlib
import importlib.util
import mmap
import os
import random
import resource
import signal
import struct
import sys
import time
from pathlib import Path
from typing import Any

COUNTS = struct.Struct("<QQdQI")
"""Files tried, files read, the most processor seconds of one, the most bytes of memory that the process had, and the
length of the file that is being tried, whose bytes follow."""

ROOM = 2**20
FRESH = 0.3
"""Share of files that are made of a good one, and not of what a run has kept."""

MEMORY = 600 * 10**6
"""Bytes that a file may make the process grow by."""

HANG_SECONDS = 30.0
"""Processor seconds after which the process is ended, in whatever loop it is."""


class Board:
    """Counts, and the bytes of the file at hand, where they outlive the process."""

    def __init__(self, path: Path) -> None:
        with path.open("r+b") as file:
            self._map = mmap.mmap(file.fileno(), ROOM)
        self.tried, self.read, self.slowest, self.largest, self._length = COUNTS.unpack_from(self._map)

    def begin(self, data: bytes) -> None:
        """Keep what is tried now."""
        self._map[COUNTS.size : COUNTS.size + len(data)] = data
        self.tried += 1
        self._length = len(data)
        self._write()

    def end(self, *, read: bool, seconds: float) -> None:
        """It was no fault."""
        self.read += read
        self.slowest = max(self.slowest, seconds)
        self.largest = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
        self._length = 0
        self._write()

    def _write(self) -> None:
        COUNTS.pack_into(self._map, 0, self.tried, self.read, self.slowest, self.largest, self._length)

    @property
    def at_hand(self) -> bytes:
        """The file that was being tried last; empty where it was done."""
        return self._map[COUNTS.size : COUNTS.size + self._length]


def main(board: Board, corpus: Path, seconds: int, seed: int) -> None:
    """Try files for so long."""
    guided = importlib.util.find_spec("atheris") is not None
    if guided:
        _instrument()
    from tests.fuzz.mutations import mutated
    from tests.fuzz.seeds import LARGEST, seeds
    from tests.fuzz.target import attempt

    def one(data: bytes) -> None:
        board.begin(data)
        signal.setitimer(signal.ITIMER_PROF, HANG_SECONDS)
        read, seconds = attempt(data)
        signal.setitimer(signal.ITIMER_PROF, 0)
        board.end(read=read, seconds=seconds)

    faulthandler.enable()
    signal.signal(signal.SIGPROF, signal.SIG_DFL)  # ends the process, in whatever loop it is
    beginnings = seeds()
    good = []
    for data in beginnings:
        read = board.read
        one(data)
        good += [data] * (board.read - read)
    _bound_memory()
    if guided:
        _keep(beginnings, corpus)
        _guided(one, mutated, good, corpus, seconds, seed, LARGEST)
    draw, until = random.Random(seed), time.monotonic() + seconds
    while time.monotonic() < until:
        data = draw.choice(good if draw.random() < FRESH else beginnings)
        for _ in range(draw.choice((1, 1, 2, 4))):
            data = mutated(data, draw, LARGEST)
        one(data)


def _instrument() -> None:
    """Count the branches of the readers; compiled loops, loaded before, stay as they are."""
    import atheris

    with atheris.instrument_imports(include=["caesura.formats"]):
        pass


def _bound_memory() -> None:
    pages = int(Path("/proc/self/statm").read_text().split()[0]) if sys.platform == "linux" else 0
    if pages:
        most = pages * resource.getpagesize() + MEMORY
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def _keep(beginnings: list[bytes], corpus: Path) -> None:
    for data in beginnings:
        (corpus / hashlib.sha1(data).hexdigest()).write_bytes(data)


def _guided(one: Any, mutated: Any, good: list[bytes], corpus: Path, seconds: int, seed: int, largest: int) -> None:
    import atheris

    def mutator(data: bytes, largest: int, number: int) -> bytes:
        draw = random.Random(number)
        if draw.random() < 0.1:
            return atheris.Mutate(data, largest)  # type: ignore[no-any-return]
        # Most of what was kept is refused early; a good file changed once gets farther.
        return mutated(draw.choice(good) if draw.random() < FRESH else data, draw, largest)

    options = {"max_total_time": seconds, "max_len": largest, "seed": seed, "mutate_depth": 2, "print_final_stats": 1}
    # Time and memory are measured here: the clock of a busy machine, and a compiler's memory, are no fault of a file.
    options |= {"timeout": 10**6, "rss_limit_mb": 0, "verbosity": 0, "artifact_prefix": f"{corpus.parent}/"}
    flags = [f"-{name}={value}" for name, value in options.items()]
    atheris.Setup([sys.argv[0], *flags, str(corpus)], one, custom_mutator=mutator)
    atheris.Fuzz()


if __name__ == "__main__":
    _, board, corpus, seconds, seed = sys.argv
    os.environ["NUMBA_NUM_THREADS"] = "1"
    main(Board(Path(board)), Path(corpus), int(seconds), int(seed))
