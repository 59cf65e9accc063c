"""The bones of an ASF: how long they are, where they point at rest, and about which axes they turn. Light: no NumPy."""

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits

INCH = 0.0254
"""Metres. Lengths, divided by the file's own unit, are inches."""

LARGEST_ASF = 4 * 2**20
"""Bytes: fifty thousand bones have fewer."""

LONGEST_NAME = 200
FREEDOMS = ("tx", "ty", "tz", "rx", "ry", "rz", "l")
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Bone:
    """A bone that leads from the end of its parent along `vector`, in metres and the directions of the world at rest.

    It turns about `axes`: angles (degrees) about the axes of the world, in `order`, at rest. `freedoms` are what the
    motion says of it, as listed.
    """

    name: str
    parent: int
    vector: Triple
    axes: Triple
    order: str
    freedoms: tuple[str, ...]


@dataclass(frozen=True)
class Skeleton:
    """Bones, each after its parent, the first of them the root, a point; `unit` makes metres of its places."""

    bones: tuple[Bone, ...]
    unit: float
    degrees: bool


Sections = dict[str, list[list[str]]]


def read_skeleton(data: bytes, limits: Limits) -> Skeleton:
    """The skeleton of an ASF; raises `BrokenContainer("malformed-asf")` or `LimitExceeded`."""
    if len(data) > LARGEST_ASF:
        raise malformed_asf(f"has {len(data):,} bytes; a skeleton has fewer than {LARGEST_ASF:,}")
    sections = _sections(data.decode("latin1"))
    units = {words[0].lower(): words[1] for words in sections["units"] if len(words) == 2}
    length = _number(units.get("length", "1"))
    if not length > 0:
        raise malformed_asf(f"has a unit of length of {length:g}")
    unit = INCH / length
    degrees = not units.get("angle", "deg").lower().startswith("rad")
    described = {bone.name: bone for bone in _described_bones(sections["bonedata"], unit, degrees, limits)}
    bones = [_root(sections["root"], degrees)]
    places = {"root": 0}
    for parent, *children in _hierarchy(sections["hierarchy"], set(described)):
        for name in children:
            places[name] = len(bones)
            bone = described[name]
            bones.append(Bone(name, places[parent], bone.vector, bone.axes, bone.order, bone.freedoms))
    return Skeleton(tuple(bones), unit, degrees)


def malformed_asf(what: str) -> BrokenContainer:
    """The refusal of an ASF."""
    return BrokenContainer("malformed-asf", f"The ASF {what}. Export it again.")


def _sections(text: str) -> Sections:
    """The lines of words after each keyword, such as `:units`."""
    sections: Sections = defaultdict(list)
    current: list[list[str]] = []
    for line in text.splitlines():
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if words[0].startswith(":"):
            current = sections[words[0][1:].lower()]
        else:
            current.append(words)
    return sections


def _root(lines: list[list[str]], degrees: bool) -> Bone:
    said = {words[0].lower(): words[1:] for words in lines}
    freedoms = _freedoms(said.get("order", ["TX", "TY", "TZ", "RX", "RY", "RZ"]))
    order = "".join(said.get("axis", ["XYZ"]))
    return Bone("root", -1, (0, 0, 0), _triple(said.get("orientation", ["0"] * 3), degrees), _order(order), freedoms)


def _described_bones(lines: list[list[str]], unit: float, degrees: bool, limits: Limits) -> Iterator[Bone]:
    said: dict[str, list[str]] = {}
    count = 1
    for words in lines:
        match words[0].lower():
            case "begin":
                said = {}
            case "end":
                count += 1
                limits.check("max_nodes", 2 * count)
                yield _bone(said, unit, degrees)
            case name:
                said[name] = words[1:]


def _bone(said: dict[str, list[str]], unit: float, degrees: bool) -> Bone:
    name = " ".join(said.get("name", []))
    if not name or len(name) > LONGEST_NAME:
        raise malformed_asf(f"has a bone without a name of at most {LONGEST_NAME} letters")
    x, y, z = _triple(said.get("direction", []), True)
    length = _number((said.get("length") or [""])[0]) * unit
    *angles, order = said.get("axis") or ["0", "0", "0", "xyz"]
    freedoms = _freedoms(said.get("dof", []))
    return Bone(name, -1, (x * length, y * length, z * length), _triple(angles, degrees), _order(order), freedoms)


def _hierarchy(lines: list[list[str]], names: set[str]) -> list[list[str]]:
    """The lines that name a bone and its children, each after the one that names it as a child."""
    below = {words[0]: words[1:] for words in lines if words[0] not in {"begin", "end"}}
    waiting, found, seen = ["root"], [], {"root"}
    for parent in waiting:  # which grows while it is walked
        children = below.pop(parent, [])
        for name in children:
            if name not in names or name in seen:
                raise malformed_asf(f"has {name[:40]!r} in its hierarchy, which is no bone, or is there twice")
            seen.add(name)
        waiting.extend(children)
        found.append([parent, *children])
    if below:
        raise malformed_asf(f"has {next(iter(below))[:40]!r} in its hierarchy, which nothing leads to from the root")
    return found


def _freedoms(words: list[str]) -> tuple[str, ...]:
    found = tuple(word.lower() for word in words)
    if not set(found) <= set(FREEDOMS) or len(set(found)) < len(found):
        raise malformed_asf(f"has a bone that is free in {' '.join(found)[:40]!r}")
    return found


def _order(word: str) -> str:
    order = word.lower()
    if not order or not set(order) <= set("xyz") or len(set(order)) < len(order):
        raise malformed_asf(f"has the axes {word[:40]!r}")
    return order


def _triple(words: list[str], degrees: bool) -> Triple:
    if len(words) != 3:
        raise malformed_asf("has other than three numbers where a direction or an axis belongs")
    scale = 1.0 if degrees else math.degrees(1)
    x, y, z = (_number(word) * scale for word in words)
    return x, y, z


def _number(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        raise malformed_asf(f"has {word[:40]!r} where a number belongs") from None
    if not abs(value) < 1e15:
        raise malformed_asf("has a number that is not finite")
    return value
