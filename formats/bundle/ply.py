"""A PLY, read: the vertices and faces of a file in ASCII or binary. What else it has is passed over.

Turk, The PLY Polygon File Format (1994).
"""

import struct
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.limits import Limits
from caesura.formats.bundle.polygon_mesh import PolygonMesh, malformed_shape, numbers, whole_numbers

LONGEST_HEADER = 2**16
MOST_LISTS = 4
CORNERS = ("vertex_indices", "vertex_index")
ORDERS = {"ascii": "=", "binary_little_endian": "<", "binary_big_endian": ">"}
TYPES = {
    "char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
    "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f", "float64": "d",
}  # fmt: skip
"""As `struct` and NumPy call them."""


@dataclass(frozen=True)
class List:
    """A property of many items, `gap` bytes after the list before it; its length comes first."""

    name: str
    gap: int
    length: str
    item: str


@dataclass
class Element:
    """Rows of one kind: their lists, and the bytes after the last list, with the place and the type of each number."""

    name: str
    count: int
    lists: list[List] = field(default_factory=list)
    numbers: dict[str, tuple[int, str]] = field(default_factory=dict)
    width: int = 0

    def add_number(self, name: str, kind: str) -> None:
        """One more property, after the others."""
        self.numbers[name] = (self.width, kind)
        self.width += struct.calcsize(kind)

    def add_list(self, name: str, length: str, item: str) -> None:
        """One more property, after the others."""
        self.lists.append(List(name, self.width, length, item))
        self.width = 0

    def corners(self) -> int:
        """Which of its lists names vertices; the first of an element that has none."""
        if len(self.lists) > MOST_LISTS:
            raise malformed_shape(f"has more than {MOST_LISTS} lists in a row")
        return next((place for place, entry in enumerate(self.lists) if entry.name in CORNERS), 0)


def read_ply(data: bytes, limits: Limits) -> PolygonMesh:
    """The vertices and faces.

    Raises `InvalidModel("malformed-shape")`, also where there are more or fewer rows than the header says, or
    `LimitExceeded`.
    """
    elements, is_text, start = _read_header(data, limits)
    # Every number of a text is read as a double: then text is read as binary is.
    rows = numbers(data[start:]).data.cast("B") if is_text else memoryview(data)[start:]
    mesh = PolygonMesh(np.zeros((0, 3)), np.zeros(0, np.int64), np.zeros(0, np.int64))
    at = 0
    for element in elements:
        starts, sizes, end = _find_lists(rows, element, at)
        if element.name == "vertex":
            mesh = replace(mesh, vertices=_read_vertices(rows, element, at))
        elif element.name == "face" and element.lists:
            limits.check("max_triangles", float(np.maximum(sizes - 2, 1).sum()))
            corners = _read_items(rows, element.lists[element.corners()].item, starts, sizes)
            mesh = replace(mesh, corners=whole_numbers(corners), sizes=sizes)
        at = end
    if at != len(rows):
        raise malformed_shape("has more rows than its header says")
    return mesh


def _read_header(data: bytes, limits: Limits) -> tuple[list[Element], bool, int]:
    """The elements, whether their rows are text, and where these begin."""
    end = data.find(b"end_header", 0, LONGEST_HEADER)
    start = data.find(b"\n", end) + 1
    if not data.startswith(b"ply") or end < 0 or not start:
        raise malformed_shape("has no header of a PLY")
    form, elements = "", [Element("", 0)]
    for words in map(str.split, data[3:end].decode("latin1").splitlines()):
        match words:
            case ["format", name, _] if name in ORDERS:
                form = name
            case ["element", name, count] if count.isdecimal() and len(count) < 16:
                limits.check("max_vertices" if name == "vertex" else "max_triangles", int(count))
                elements.append(Element(name, int(count)))
            case ["property", "list", length, item, name] if form and {length, item} <= TYPES.keys():
                elements[-1].add_list(name, _code(form, length), _code(form, item))
            case ["property", kind, name] if form and kind in TYPES:
                elements[-1].add_number(name, _code(form, kind))
            case [] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise malformed_shape(f"has {' '.join(words)[:60]!r} in its header")
    return elements, form == "ascii", start


def _code(form: str, kind: str) -> str:
    return "=d" if form == "ascii" else ORDERS[form] + TYPES[kind]


def _find_lists(
    rows: memoryview, element: Element, at: int
) -> tuple[Int[np.ndarray, "rows"], Int[np.ndarray, "rows"], int]:
    """Where the corners of each row begin, how many there are, and where the element ends."""
    found: list[tuple[int, int]] = []
    if not element.lists or not element.count:
        end = at + element.count * element.width
    elif (end := _end_of_equal_rows(rows, element, at)) <= len(rows):
        start, size = _read_row(rows, element, at)[0][element.corners()]
        width = (end - at) // element.count
        return start + width * np.arange(element.count), np.full(element.count, size), end
    else:
        place, end = element.corners(), at
        for _ in range(element.count):
            row, end = _read_row(rows, element, end)
            found.append(row[place])
    if end > len(rows):
        raise malformed_shape("has fewer rows than its header says")
    starts, sizes = np.array(found, np.int64).reshape(-1, 2).T
    return starts, sizes, end


def _end_of_equal_rows(rows: memoryview, element: Element, at: int) -> int:
    """Where the element ends if all its lists are as long as in its first row; beyond the end where they are not."""
    lists, end = _read_row(rows, element, at)
    width, beyond = end - at, len(rows) + 1
    if at + element.count * width > len(rows):
        return beyond
    for entry, (start, size) in zip(element.lists, lists, strict=True):
        place = start - struct.calcsize(entry.length)
        if (np.ndarray((element.count,), entry.length, rows, place, (width,)) != size).any():
            return beyond
    return at + element.count * width


def _read_row(rows: memoryview, element: Element, at: int) -> tuple[list[tuple[int, int]], int]:
    """Where each list of the row at `at` begins and how long it is, and where the row ends."""
    found = []
    for entry in element.lists:
        at += entry.gap
        start = at + struct.calcsize(entry.length)
        if start > len(rows):
            raise malformed_shape("has fewer rows than its header says")
        (size,) = struct.unpack_from(entry.length, rows, at)
        if not 0 <= size <= len(rows) or size != int(size):
            raise malformed_shape(f"has a list of {size} items")
        found.append((start, int(size)))
        at = start + int(size) * struct.calcsize(entry.item)
    return found, at + element.width


def _read_vertices(rows: memoryview, element: Element, at: int) -> Float[np.ndarray, "V 3"]:
    if element.lists or not {"x", "y", "z"} <= element.numbers.keys():
        raise malformed_shape("has vertices without x, y and z, or with lists")
    columns = [
        np.ndarray((element.count,), kind, rows, at + place, (element.width,))
        for place, kind in (element.numbers[axis] for axis in "xyz")
    ]
    return np.stack(columns, axis=1).astype(np.float64)


def _read_items(
    rows: memoryview, item: str, starts: Int[np.ndarray, "rows"], sizes: Int[np.ndarray, "rows"]
) -> Float[np.ndarray, "items"]:
    """The items of all lists, one after the other."""
    width = struct.calcsize(item)
    within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    places = np.repeat(starts, sizes) + width * within
    data = np.frombuffer(rows, np.uint8)[places[:, None] + np.arange(width)]
    return np.asarray(data.view(item).ravel(), np.float64)
