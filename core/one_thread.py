"""BLAS and OpenMP on one thread: the same bits whatever the machine, and forks that do not hang."""

from contextlib import AbstractContextManager
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController


def one_thread() -> AbstractContextManager[Any]:
    """`threadpool_limits(1)`, but for the search through all loaded libraries, which takes longer than some cuts.

    They are searched at the first call, so call it when everything is imported, as from within a function.
    """
    limits: AbstractContextManager[Any] = _libraries().limit(limits=1)
    return limits


@cache
def _libraries() -> ThreadpoolController:
    return ThreadpoolController()
