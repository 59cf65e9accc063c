"""The header of a NumPy array file, read without NumPy: the web process reads it too."""

import ast
import math
import re
from dataclasses import dataclass
from typing import BinaryIO

from caesura.core.errors import BrokenContainer, InvalidModel

MAGIC = b"\x93NUMPY"
LONGEST = 10_000
"""Bytes of a header; NumPy's own bound for headers of strangers."""

NUMBERS = re.compile(r"([<>=|]?)([iuf])([1248])")
"""Types of plain numbers. Python objects, structures, complex and long doubles are none of ours."""


@dataclass(frozen=True)
class NpyHeader:
    """Type, order and shape of one array, and how many bytes its header takes."""

    dtype: str
    fortran_order: bool
    shape: tuple[int, ...]
    bytes: int

    @property
    def data_bytes(self) -> int:
        """Bytes of the numbers themselves."""
        return math.prod(self.shape) * int(self.dtype[-1])


def read_npy_header(file: BinaryIO, name: str) -> NpyHeader:
    """The header at the start of `file`, the archive's member `name`.

    Raises `BrokenContainer("malformed-npz")`, or `InvalidModel("unsupported-dtype")` for anything but numbers.
    """
    start = file.read(len(MAGIC) + 2)
    if start[:-2] != MAGIC or start[-2] not in (1, 2, 3):
        raise _malformed(name, "is not a NumPy array")
    width = 2 if start[-2] == 1 else 4
    length = int.from_bytes(file.read(width), "little")
    if length > LONGEST:
        raise _malformed(name, f"has a header of {length:,} bytes")
    text = file.read(length)
    if len(text) < length:
        raise _malformed(name, "ends within its header")
    dtype, fortran_order, shape = _fields(text, name)
    return NpyHeader(dtype, fortran_order, shape, len(start) + width + length)


def _fields(text: bytes, name: str) -> tuple[str, bool, tuple[int, ...]]:
    try:
        # Literals only; what is deep or long enough to break the parser is refused with the rest.
        value = ast.literal_eval(text.decode("latin1"))
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        raise _malformed(name, "has a header that cannot be read") from None
    if not isinstance(value, dict) or value.keys() != {"descr", "fortran_order", "shape"}:
        raise _malformed(name, "has a header without type, order and shape")
    shape, fortran_order, dtype = value["shape"], value["fortran_order"], value["descr"]
    if not isinstance(shape, tuple) or not all(type(n) is int and n >= 0 for n in shape) or len(shape) > 32:
        raise _malformed(name, "has no proper shape")
    if not isinstance(fortran_order, bool):
        raise _malformed(name, "has no proper order")
    if not isinstance(dtype, str) or not (found := NUMBERS.fullmatch(dtype)) or found[2] + found[3] == "f1":
        raise InvalidModel(
            "unsupported-dtype", f"{name} must be an array of plain numbers, such as float32.", pointer=f"/{name}"
        )
    return dtype, fortran_order, shape


def _malformed(name: str, what: str) -> BrokenContainer:
    return BrokenContainer("malformed-npz", f"The archive's {name!r} {what}. Save it again with numpy.savez.")
