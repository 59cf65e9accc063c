"""One object of the JSON, asked by name and checked at every answer. Light: no NumPy."""

import math
from typing import Any

from caesura.core.errors import InvalidModel

Json = dict[str, Any]


class JsonObject:
    """A JSON object and the pointer to it. Every question names what it expects, or raises `InvalidModel`.

    JSON has one kind of number and Python many: `true` counts as 1, -1 counts from the end of a list, and
    NumPy reads a count of -1 as "all". So nothing is used that has not been asked for here.
    """

    __slots__ = ("pointer", "value")

    def __init__(self, value: Json, pointer: str) -> None:
        self.value = value
        self.pointer = pointer

    def __contains__(self, name: str) -> bool:
        return name in self.value

    def refusal(self, detail: str, code: str = "invalid-gltf", name: str | None = None) -> InvalidModel:
        """The error that says `detail` of this object, or of its member `name`."""
        place = self.pointer if name is None else f"{self.pointer}/{name}"
        return InvalidModel(code, _text(detail), pointer=_text(place))

    def index(self, name: str, count: int, of: str, code: str = "invalid-gltf") -> int:
        """The member `name`, which must be one of 0 … count - 1: a place in the list called `of`."""
        value = self.value.get(name)
        if type(value) is int and 0 <= value < count:
            return value
        raise self.refusal(f"{name} must be the number of one of {count} {of}, not {_shown(value)}.", code, name)

    def whole(self, name: str, default: int | None = None, code: str = "invalid-gltf") -> int:
        """The member `name`, an integer of at least 0; its absence is `default`, unless that is None."""
        value = self.value.get(name, default)
        if type(value) is not int:
            raise self.refusal(f"{name} must be a whole number, not {_shown(value)}.", name=name)
        if value < 0:
            raise self.refusal(f"{name} must not be negative, as {_shown(value)} is.", code, name)
        return min(value, BEYOND)

    def text(self, name: str, default: str | None = None) -> str:
        """The member `name`, a string; its absence is `default`, unless that is None."""
        value = self.value.get(name, default)
        if isinstance(value, str):
            return _utf8(value)
        raise self.refusal(f"{name} must be text, not {_shown(value)}.", name=name)

    def choice(self, name: str, known: tuple[str, ...], default: str | None = None) -> str:
        """The member `name`, which must be one of the `known` words."""
        value = self.text(name, default)
        if value in known:
            return value
        raise self.refusal(f"{name} must be one of {', '.join(known)}, not {_shown(value)}.", name=name)

    def flag(self, name: str) -> bool:
        """The member `name`, true or false; its absence is false."""
        value = self.value.get(name, False)
        if isinstance(value, bool):
            return value
        raise self.refusal(f"{name} must be true or false, not {_shown(value)}.", name=name)

    def numbers(self, name: str, length: int | None, default: tuple[float, ...]) -> tuple[float, ...]:
        """The member `name`, so many finite numbers; any number of them where `length` is None."""
        values = self.value.get(name)
        if values is None and name not in self.value:
            return default
        if not isinstance(values, list) or length not in (None, len(values)):
            raise self.refusal(f"{name} must be a list of {length or ''} numbers, not {_shown(values)}.", name=name)
        return tuple(self._number(name, value) for value in values)

    def _number(self, name: str, value: Any) -> float:
        if type(value) not in (int, float):
            raise self.refusal(f"{name} must hold numbers, not {_shown(value)}.", name=name)
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not abs(number) <= FLOAT32_MAX:
            raise self.refusal(f"{name} holds a number that float32 cannot.", "non-finite-data", name)
        return number

    def entry(self, name: str) -> "JsonObject | None":
        """The member `name`, an object, or None where it is absent."""
        if name not in self.value:
            return None
        value = self.value[name]
        if isinstance(value, dict):
            return JsonObject(value, f"{self.pointer}/{name}")
        raise self.refusal(f"{name} must be an object, not {_shown(value)}.", name=name)

    def values(self, name: str) -> list[Any]:
        """The member `name`, a list; its absence is an empty one."""
        value = self.value.get(name, [])
        if isinstance(value, list):
            return value
        raise self.refusal(f"{name} must be a list, not {_shown(value)}.", name=name)

    def entries(self, name: str) -> "list[JsonObject]":
        """The member `name`, a list of objects; its absence is an empty one."""
        values = self.values(name)
        for place, value in enumerate(values):
            if not isinstance(value, dict):
                raise self.refusal(f"{name} must hold objects, not {_shown(value)}.", name=f"{name}/{place}")
        return [JsonObject(value, f"{self.pointer}/{name}/{place}") for place, value in enumerate(values)]

    def extension(self, *names: str) -> "JsonObject | None":
        """The first of the extensions `names` that this object has."""
        extensions = self.entry("extensions")
        if extensions is None:
            return None
        return next((found for name in names if (found := extensions.entry(name)) is not None), None)


FLOAT32_MAX = 3.4028234663852886e38

BEYOND = 2**100
"""What stands for any larger number: no file reaches it, and Python can still divide and print it."""


LONGEST = 500
"""Letters of a refusal: names in a file may be as long as the file."""


def _utf8(text: str) -> str:
    """A lone surrogate is legal in JSON and cannot be written as UTF-8."""
    return text.encode("utf-8", "replace").decode("utf-8")


def _text(told: str) -> str:
    """What a person is told, however the names in it are made."""
    return _utf8(told if len(told) <= LONGEST else f"{told[:LONGEST]}…")


def _shown(value: Any) -> str:
    """A value as a person may read it in one line, however large it is."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if value is None:
        return "nothing"
    return repr(value)[:60] if not isinstance(value, int) or value.bit_length() < 200 else "a huge number"
