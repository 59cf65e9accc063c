"""The parameters of a C3D: arrays of letters, integers or reals, by group and name. Light: no NumPy.

An entry is the length of its name (negative where it is locked), the number of its group (negative where it is the
group itself), its name, and how far the next entry is from there. A parameter goes on with the bytes of an element
(-1 for letters), the number of its dimensions and their sizes, and the elements, the first dimension fastest.
"""

import math
from dataclasses import dataclass, field

from caesura.formats.c3d.number_encodings import Numbers

LETTERS, BYTES, INTEGERS, REALS = -1, 1, 2, 4
MOST_DIMENSIONS = 7
SECTION = 255 * 512


@dataclass(frozen=True)
class Parameter:
    """An array: bytes of an element, sizes, and where its elements begin."""

    kind: int
    sizes: tuple[int, ...]
    place: int


@dataclass
class ParameterSection:
    """All parameters; what is missing, or of another type, is nothing or 0."""

    numbers: Numbers
    groups: dict[int, str] = field(default_factory=dict)
    entries: dict[tuple[int, str], Parameter] = field(default_factory=dict)

    def integers(self, group: str, name: str) -> list[int]:
        """The unsigned integers of a parameter."""
        found = self._find(group, name)
        if found is None or found.kind != INTEGERS:
            return []
        return [self.numbers.word(found.place + 2 * i) for i in range(math.prod(found.sizes))]

    def integer(self, group: str, name: str) -> int:
        """The first integer."""
        return next(iter(self.integers(group, name)), 0)

    def real(self, group: str, name: str) -> float:
        """The first real."""
        found = self._find(group, name)
        return self.numbers.real(found.place) if found and found.kind == REALS and math.prod(found.sizes) else 0.0

    def texts(self, group: str, name: str) -> list[str]:
        """The texts of a parameter, and of those that go on with it, `LABELS2` and so on, for more than 255."""
        texts: list[str] = []
        further = 1
        while (found := self._find(group, name if further == 1 else f"{name}{further}")) and found.kind == LETTERS:
            length, *counts = found.sizes or (1,)
            for i in range(math.prod(counts)):
                start = found.place + i * length
                texts.append(self.numbers.data[start : start + length].decode("utf-8", "replace").strip(" \0"))
            further += 1
        return texts

    def _find(self, group: str, name: str) -> Parameter | None:
        return next(
            (
                entry
                for (number, called), entry in self.entries.items()
                if (self.groups.get(number), called) == (group, name)
            ),
            None,
        )


def read_parameters(numbers: Numbers, place: int) -> ParameterSection:
    """The parameters whose section begins at byte `place`. A section that breaks off has those before."""
    section = ParameterSection(numbers)
    data = numbers.data
    end, at = min(place + SECTION, len(data)), place + 4
    while at + 4 < end:
        letters, group = abs(_signed(data[at])), _signed(data[at + 1])
        link = at + 2 + letters
        if not letters or not group or link + 4 > end:
            break
        name = data[at + 2 : link].decode("ascii", "replace").strip().upper()
        if group < 0:
            section.groups.setdefault(-group, name)
        else:
            dimensions = data[link + 3]
            first = link + 4 + dimensions
            entry = Parameter(_signed(data[link + 2]), tuple(data[link + 4 : first]), first)
            if dimensions <= MOST_DIMENSIONS and first + abs(entry.kind) * math.prod(entry.sizes) <= end:
                section.entries.setdefault((group, name), entry)
        step = numbers.word(link)
        if not 0 < step < SECTION:
            break
        at = link + step
    return section


def _signed(byte: int) -> int:
    return byte - 256 if byte > 127 else byte
