"""What a reader assumed or left out, told once each however often it happened. Light: no NumPy."""

from caesura.core.document import Notice


class Notices:
    """A collection of notices with one sentence for every code, and a count of the rest.

    A hostile file can give a hundred thousand reasons for the same notice; the person reads the first.
    """

    def __init__(self) -> None:
        self._first: dict[str, str] = {}
        self._count: dict[str, int] = {}

    def add(self, code: str, detail: str) -> None:
        """Note `detail`, unless this code was noted before."""
        self._first.setdefault(code, detail)
        self._count[code] = self._count.get(code, 0) + 1

    def told(self) -> tuple[Notice, ...]:
        """The notices in the order in which they first came."""
        return tuple(
            Notice(code=code, detail=detail if self._count[code] == 1 else f"{detail} ({self._count[code]} in all)")
            for code, detail in self._first.items()
        )
