"""Numbers as the processors wrote them that C3D was made on. Light: no NumPy.

Intel and DEC put the low byte of an integer first, SGI the high one. Reals are IEEE 754 on Intel and SGI. A real of a
DEC (VAX F) has its two halves the other way round, and an exponent larger by two: it is the IEEE number of the halves
exchanged, divided by four.
"""

import struct
from dataclasses import dataclass
from enum import IntEnum


class Processor(IntEnum):
    """The number that the parameters begin with."""

    INTEL = 84
    DEC = 85
    SGI = 86


@dataclass(frozen=True)
class Numbers:
    """Reads integers of 16 bits and reals at a place of `data`."""

    data: bytes
    processor: Processor

    @property
    def order(self) -> str:
        """The order of bytes, as `struct` and NumPy call it."""
        return ">" if self.processor == Processor.SGI else "<"

    def word(self, place: int) -> int:
        """The unsigned integer at a byte; 0 beyond the end."""
        piece = self.data[place : place + 2]
        return int(struct.unpack(f"{self.order}H", piece)[0]) if len(piece) == 2 else 0

    def real(self, place: int) -> float:
        """The real at a byte; 0 beyond the end."""
        piece = self.data[place : place + 4]
        if len(piece) < 4:
            return 0.0
        if self.processor == Processor.DEC:
            return float(struct.unpack("<f", piece[2:] + piece[:2])[0]) / 4
        return float(struct.unpack(f"{self.order}f", piece)[0])
