"""How many bytes may still be decoded."""

from caesura.core.limits import Limits


class DecodeBudget:
    """Counts what is decoded, every use of it, before it is allocated.

    One small view can be referenced a hundred thousand times, and an accessor without data is all zeros of any
    number: the size of a file says nothing of what it unfolds to.
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self.spent = 0

    def spend(self, size: int, pointer: str | None = None) -> None:
        """Count `size` more bytes of what `pointer` names; raises `LimitExceeded` where that is too much."""
        self.check(size, pointer)
        self.spent += size

    def check(self, size: int, pointer: str | None = None) -> None:
        """Raise `LimitExceeded` where `size` more bytes would be too much."""
        self._limits.check("max_decoded_bytes", self.spent + size, pointer=pointer)
