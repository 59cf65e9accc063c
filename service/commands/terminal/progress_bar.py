"""Where a long computation stands: one line on stderr, drawn over itself."""

import sys
import time
from types import TracebackType
from typing import Self

from caesura.worker.control_characters import escape_control_characters

WIDTH = 30
BETWEEN_SECONDS = 0.1  # redrawn no oftener: a terminal over a slow line must not hold the work up


class ProgressBar:
    """Call it with a stage and a fraction, 0 to 1. It draws nothing where stderr is no terminal."""

    def __init__(self) -> None:
        self._drawn = 0.0
        self._visible = sys.stderr.isatty()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        if self._drawn:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()

    def __call__(self, stage: str, fraction: float) -> None:
        """Draw, unless it was just drawn."""
        now = time.monotonic()
        if not self._visible or now - self._drawn < BETWEEN_SECONDS:
            return
        self._drawn = now
        full = round(WIDTH * min(max(fraction, 0.0), 1.0))
        bar = f"{'█' * full}{'░' * (WIDTH - full)} {fraction:4.0%} {escape_control_characters(stage)}"
        sys.stderr.write(f"\r\033[K{bar}")
        sys.stderr.flush()
