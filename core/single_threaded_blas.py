"""BLAS and OpenMP on one thread: the same bits whatever the machine, and forks that do not hang."""

import sys
from contextlib import AbstractContextManager
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController


def single_threaded_blas() -> AbstractContextManager[Any]:
    """`threadpool_limits(1)`, but for the search through all loaded libraries, which takes longer than some cuts.

    They are searched at the first call, and once more where scikit-learn, with its OpenMP, was imported since.
    """
    limits: AbstractContextManager[Any] = _libraries("sklearn" in sys.modules).limit(limits=1)
    return limits


@cache
def _libraries(scikit_learn: bool) -> ThreadpoolController:  # noqa: ARG001  what was found with it and without it
    return ThreadpoolController()
