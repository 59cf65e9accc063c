"""How long things take, next to each other: the best of several turns, in processor time and on the clock."""

import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from time import perf_counter, process_time
from typing import NamedTuple, Self

SAMPLE_SECONDS = 0.005


class Cost(NamedTuple):
    """The least of several turns. `busy` is the processor time of all threads, which other programs disturb less."""

    clock: float
    busy: float


def least(functions: Mapping[str, Callable[[], object]], turns: int) -> dict[str, Cost]:
    """The cost of each, taken in alternation, so that all see the same machine; the first turn warms up."""
    found: dict[str, list[Cost]] = {name: [] for name in functions}
    for turn in range(turns + 1):
        for name, function in functions.items():
            clock, busy = perf_counter(), process_time()
            function()
            if turn:
                found[name].append(Cost(perf_counter() - clock, process_time() - busy))
    return {name: Cost(min(c.clock for c in of_it), min(c.busy for c in of_it)) for name, of_it in found.items()}


class AnonymousPeak:
    """The most anonymous memory that this process held while a block ran, in bytes beyond what it held before.

    Linux alone; `bytes` stays 0 where there is no /proc.
    """

    def __enter__(self) -> Self:
        self.bytes, self._before = 0, anonymous()
        self._over = threading.Event()
        self._watch = threading.Thread(target=self._look)
        self._watch.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._watch.join()

    def _look(self) -> None:
        while not self._over.wait(SAMPLE_SECONDS):
            self.bytes = max(self.bytes, anonymous() - self._before)


def anonymous(process: str = "self") -> int:
    """Bytes of anonymous memory of a process; 0 where it has ended, or there is no /proc."""
    try:
        lines = (Path("/proc") / process / "status").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("RssAnon")), 0)
