"""How objects of the library have to be treated.

Version 0.0.5 of ufbx gives every object out with one reference too few: it would be freed while its scene still
points to it. So whatever is taken is held until the process ends, which collects no garbage (`native.reader_main`).
"""

from collections.abc import Iterable
from typing import Any

import numpy as np
from jaxtyping import Float, Int

_held: list[Any] = []


def held(taken: Any) -> Any:
    """An object of the library, for good."""
    _held.append(taken)
    return taken


def all_held(taken: Iterable[Any]) -> list[Any]:
    """The objects in a list of the library."""
    _held.append(taken)
    found = list(taken)
    _held.extend(found)
    return found


def whole_numbers(taken: Any) -> Int[np.ndarray, "_"]:
    """A list of indices; what the library calls no index is -1."""
    numbers = np.fromiter(held(taken), np.int64, len(taken))
    numbers[numbers == 2**32 - 1] = -1
    return numbers


def numbers(taken: Any) -> Float[np.ndarray, "..."]:
    """A list of numbers, or of vectors, a row each."""
    return np.array(held(taken), np.float64)


def matrix(taken: Any) -> Float[np.ndarray, "4 4"]:
    """An affine matrix; the library has its columns."""
    found = np.eye(4)
    found[:3] = np.array(taken).T
    return found
