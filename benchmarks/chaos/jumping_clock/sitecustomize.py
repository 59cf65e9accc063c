"""A wall clock that another process moves: Python loads this at its start where this folder is on PYTHONPATH.

`JUMPING_CLOCK` names a file that holds the seconds by which it is wrong. The monotonic clock is left alone, as it is by
whoever sets the time of a machine. Redis is no Python, and keeps its own time.
"""

import datetime
import os
import sys
import time
from importlib.abc import MetaPathFinder
from pathlib import Path
from typing import Any

OFFSET = Path(os.environ["JUMPING_CLOCK"])

system_time = time.time
SystemDatetime = datetime.datetime


def jumped_time() -> float:
    """Seconds since 1970 by the clock that is wrong."""
    return system_time() + float(OFFSET.read_text() or 0)


class _IsDatetime(type):
    def __instancecheck__(cls, value: object) -> bool:
        return isinstance(value, SystemDatetime)


class JumpedDatetime(SystemDatetime, metaclass=_IsDatetime):
    """`datetime` by the same clock."""

    @classmethod
    def now(cls, tz: datetime.tzinfo | None = None) -> Any:
        """The time now."""
        return SystemDatetime.fromtimestamp(jumped_time(), tz)


class WithoutPandas(MetaPathFinder):
    """pandas, where it is installed, is built against the real `datetime`; scikit-learn does without it."""

    def find_spec(self, fullname: str, *_: object, **__: object) -> None:
        """Refuse pandas, and leave all else to others."""
        if fullname == "pandas":
            raise ModuleNotFoundError(fullname)


sys.meta_path.insert(0, WithoutPandas())
time.time = jumped_time
datetime.datetime = JumpedDatetime  # type: ignore[misc]  # to replace it is what this is for
