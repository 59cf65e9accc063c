"""A text FBX as a binary one: the same records, with their lengths."""

import re
import struct
import zlib
from dataclasses import dataclass, field

VERSION = 7400
LINE = re.compile(r"^\s*(\w+):\s*(.*?)\s*(\{)?\s*$")
VALUE = re.compile(r'"([^"]*)"|([^,\s]+)')
MODEL = re.compile(r"^(\w+)::(.*)$", re.DOTALL)
INTEGERS = {"PolygonVertexIndex": "i", "Indexes": "i", "KeyTime": "l", "KeyAttrFlags": "i", "KeyAttrRefCount": "i"}
FLOATS = {"KeyValueFloat": "f", "KeyAttrDataFloat": "f"}


@dataclass
class _Record:
    name: str
    values: list[bytes] = field(default_factory=list)
    inner: list["_Record"] = field(default_factory=list)

    def data(self, at: int) -> bytes:
        """The record, which begins at byte `at` of the file."""
        name, properties = self.name.encode(), b"".join(self.values)
        start = at + 13 + len(name) + len(properties)
        inner = b""
        for record in self.inner:
            inner += record.data(start + len(inner))
        inner += bytes(13) if self.inner else b""
        head = struct.pack("<IIIB", start + len(inner), len(self.values), len(properties), len(name))
        return head + name + properties + inner


def binary(text: bytes) -> bytes:
    """The binary file of what `FbxText.data` has made."""
    root = _Record("")
    above = [root]
    for line in text.decode().splitlines():
        if line.strip() == "}":
            above.pop()
        elif (found := LINE.match(line)) and not line.startswith(";"):
            name, values, opens = found.groups()
            if name == "a":
                above[-1].values = [_array(above[-1].name, values)]
                continue
            record = _Record(name, [] if values.startswith("*") else [_value(one) for one in VALUE.finditer(values)])
            above[-1].inner.append(record)
            if opens:
                above.append(record)
    out = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", VERSION)
    for record in root.inner:
        out += record.data(len(out))
    return out + bytes(13 + 160)


def _value(found: re.Match[str]) -> bytes:
    text, number = found.groups()
    if number is None:
        named = MODEL.match(text)
        data = (f"{named[2]}\0\1{named[1]}" if named else text).encode()
        return b"S" + struct.pack("<I", len(data)) + data
    if re.fullmatch(r"-?\d+", number):
        return b"L" + struct.pack("<q", int(number))
    return b"D" + struct.pack("<d", float(number))


def _array(name: str, values: str) -> bytes:
    kind = INTEGERS.get(name) or FLOATS.get(name, "d")
    numbers = [int(value) if kind in "il" else float(value) for value in values.split(",") if value]
    raw = struct.pack(f"<{len(numbers)}{kind.replace('l', 'q')}", *numbers)
    packed = zlib.compress(raw)
    if len(packed) < len(raw):
        return kind.encode() + struct.pack("<III", len(numbers), 1, len(packed)) + packed
    return kind.encode() + struct.pack("<III", len(numbers), 0, len(raw)) + raw
