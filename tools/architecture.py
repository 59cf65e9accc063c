"""Draw docs/pictures/architecture.svg from the imports of the code: the packages, their rooms, and the way of the data.

    python tools/architecture.py            draws the picture
    python tools/architecture.py --check    fails where rooms import each other in a circle, or upwards, or the
                                            picture is old

A room is a folder of a package, or a file beside the folders. Within a package a room stands above all that it
imports; a circle of rooms has no such order. Imports that only the type checker reads are not drawn.
"""

import argparse
import ast
import sys
from collections import defaultdict
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "pictures" / "architecture.svg"
COLOURS = {
    "service": "#a23b72",
    "worker": "#c8553d",
    "caesura": "#6a4c93",
    "samples": "#666666",
    "formats": "#a86400",
    "core": "#2f6fb0",
}
"""The packages, from the highest to the lowest; `caesura` and `samples` are of one height."""

RANK = {"service": 0, "worker": 1, "caesura": 2, "samples": 2, "formats": 3, "core": 4}
UPLOAD = ("service/routes", "service/uploads", "service/segmentations", "worker/queue", "worker/tasks", "formats/read")
VERTICES = ("core/pipeline", "core/block_pass", "core/energy", "core/methods", "core/segmentation")
WIDTH, MARGIN, LABEL, BOX, HEIGHT, GAP, ROW = 1440, 24, 96, 142, 28, 12, 56

Imports = dict[str, set[str]]


class Point(NamedTuple):
    """A place in the picture, in pixels from the left and from the top."""

    x: float
    y: float


def find_module(name: str) -> Path | None:
    """The file of a dotted name under `caesura`, or of the module that the name belongs to."""
    parts = name.split(".")[1:]
    while parts:
        stem = ROOT.joinpath(*parts) if parts[0] in COLOURS else ROOT.joinpath("caesura", *parts)
        for path in (stem.with_suffix(".py"), stem / "__init__.py"):
            if path.is_file():
                return path
        parts.pop()
    return None


def room_of(path: Path) -> str:
    """The room of a file: `core/energy` for what lies in that folder, `core/pipeline` for a file beside it."""
    return "/".join(path.relative_to(ROOT).with_suffix("").parts[:2])


def package_of(room: str) -> str:
    """The package that a room is of."""
    return room.partition("/")[0]


def imported_names(tree: ast.AST) -> Iterator[str]:
    """What is imported, at the top or within functions, but for what only the type checker reads."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif not (isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"):
            yield from imported_names(node)


def read_imports() -> Imports:
    """Which room imports which others. A package's `__init__` is its index, and no room."""
    found: Imports = defaultdict(set)
    for package in COLOURS:
        for path in sorted((ROOT / package).rglob("*.py")):
            is_linked = any(folder.is_symlink() for folder in path.parents)
            if is_linked or path == ROOT / package / "__init__.py":
                continue
            names = imported_names(ast.parse(path.read_text(encoding="utf-8")))
            modules = (find_module(name) for name in names if name.startswith("caesura."))
            found[room_of(path)] |= {room_of(module) for module in modules if module} - {room_of(path)}
    return {room: {other for other in others if other in found} for room, others in found.items()}


def find_upward_imports(imports: Imports) -> list[str]:
    """Imports from a lower package into a higher one."""
    return [
        f"{room} -> {other}"
        for room, others in sorted(imports.items())
        for other in sorted(others)
        if RANK[package_of(other)] < RANK[package_of(room)]
    ]


def inner_imports(imports: Imports, package: str) -> Imports:
    """The imports within one package."""
    return {
        room: {other for other in others if package_of(other) == package}
        for room, others in imports.items()
        if package_of(room) == package
    }


def floors(inner: Imports) -> list[list[str]]:
    """The rooms of a package, highest first. Raises `CycleError` where rooms import each other in a circle."""
    level: dict[str, int] = {}
    for room in TopologicalSorter(inner).static_order():
        level[room] = max((level[other] + 1 for other in inner[room]), default=0)
    return [
        sorted(room for room in level if level[room] == floor) for floor in reversed(range(max(level.values()) + 1))
    ]


def place_rooms(imports: Imports) -> tuple[dict[str, Point], dict[str, tuple[float, float]]]:
    """The left upper corner of every room, and the top and bottom of every package."""
    corners: dict[str, Point] = {}
    bands: dict[str, tuple[float, float]] = {}
    room_left = MARGIN + LABEL
    across = (WIDTH - MARGIN - room_left) // (BOX + GAP)
    y = 2.5 * MARGIN
    for package in COLOURS:
        top, y = y, y + GAP
        for floor in floors(inner_imports(imports, package)):
            for start in range(0, len(floor), across):
                line = floor[start : start + across]
                share = (WIDTH - MARGIN - room_left) / len(line)
                corners |= {room: Point(room_left + (i + 0.5) * share - BOX / 2, y) for i, room in enumerate(line)}
                y += ROW if start + across >= len(floor) else HEIGHT + GAP
        y += GAP + HEIGHT - ROW
        bands[package] = (top, y)
        y += GAP
    return corners, bands


def needed_arrows(inner: Imports) -> Iterator[tuple[str, str]]:
    """The imports of a package that no longer chain of imports implies: enough to show who stands on whom."""
    below: Imports = {}
    for room in TopologicalSorter(inner).static_order():
        below[room] = inner[room].union(*(below[other] for other in inner[room]))
    for room, others in sorted(inner.items()):
        implied: set[str] = set().union(*(below[other] for other in others))
        yield from ((room, other) for other in sorted(others - implied))


def draw(imports: Imports) -> str:
    """The picture as text, the same for the same code."""
    corners, bands = place_rooms(imports)
    height = max(bottom for _, bottom in bands.values()) + MARGIN
    legend = "A room imports those below it; what a chain implies is not drawn. Green: an upload. Violet: its vertices."
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:.0f}" font-family="sans-serif">',
            "<title>The rooms of Caesura: which imports which, and the way of an upload and of its vertices</title>",
            f'<rect width="{WIDTH}" height="{height:.0f}" fill="#ffffff"/>',
            f'<text x="{MARGIN}" y="{1.5 * MARGIN}" font-size="15" fill="#222222">{legend}</text>',
            *(_band(package, *span) for package, span in bands.items()),
            *(
                _arrow(corners[room], corners[other], COLOURS[package])
                for package in COLOURS
                for room, other in needed_arrows(inner_imports(imports, package))
            ),
            *(_box(room, corner) for room, corner in corners.items()),
            *(_number(corners[room], i, "#1a7f37") for i, room in enumerate(UPLOAD, 1)),
            *(_number(corners[room], i, "#8250df") for i, room in enumerate(VERTICES, len(UPLOAD) + 1)),
            "</svg>\n",
        ]
    )


def _band(package: str, top: float, bottom: float) -> str:
    return (
        f'<rect x="{MARGIN}" y="{top:.0f}" width="{WIDTH - 2 * MARGIN}" height="{bottom - top:.0f}" rx="8"'
        f' fill="{COLOURS[package]}" fill-opacity="0.09"/><text x="{MARGIN + 12}" y="{top + 28:.0f}" font-size="16"'
        f' font-weight="bold" fill="{COLOURS[package]}">{package}/</text>'
    )


def _box(room: str, corner: Point) -> str:
    return (
        f'<rect x="{corner.x:.0f}" y="{corner.y:.0f}" width="{BOX}" height="{HEIGHT}" rx="4" fill="#ffffff"'
        f' stroke="{COLOURS[package_of(room)]}"/><text x="{corner.x + BOX / 2:.0f}" y="{corner.y + 18:.0f}"'
        f' text-anchor="middle" font-size="12" fill="#222222">{room.partition("/")[2]}</text>'
    )


def _arrow(start: Point, end: Point, colour: str) -> str:
    x1, y1, x2, y2 = start.x + BOX / 2, start.y + HEIGHT, end.x + BOX / 2, end.y
    bend = (y2 - y1) / 2
    curve = f"M{x1:.0f} {y1:.0f}C{x1:.0f} {y1 + bend:.0f} {x2:.0f} {y2 - bend:.0f} {x2:.0f} {y2:.0f}"
    return f'<path d="{curve}" fill="none" stroke="{colour}" stroke-opacity="0.55"/>'


def _number(corner: Point, number: int, colour: str) -> str:
    return (
        f'<circle cx="{corner.x:.0f}" cy="{corner.y + HEIGHT / 2:.0f}" r="11" fill="{colour}"/><text x="{corner.x:.0f}"'
        f' y="{corner.y + HEIGHT / 2 + 4:.0f}" text-anchor="middle" font-size="13" fill="#ffffff">{number}</text>'
    )


def main() -> int:
    """Draw the picture, or check that the drawn one is right."""
    parser = argparse.ArgumentParser(description="Draw the rooms of the code and check their order.")
    parser.add_argument(
        "--check", action="store_true", help="write nothing; fail where the order or the picture is wrong"
    )
    check = parser.parse_args().check
    imports = read_imports()
    try:
        text = draw(imports)
    except CycleError as error:
        sys.exit(f"These rooms import each other in a circle: {' -> '.join(error.args[1])}")
    if wrong := find_upward_imports(imports):
        sys.exit("\n  ".join(["These imports point upwards:", *wrong]))
    if not check:
        PICTURE.write_text(text, encoding="utf-8")
    elif not PICTURE.exists() or PICTURE.read_text(encoding="utf-8") != text:
        sys.exit("docs/pictures/architecture.svg is old: run python tools/architecture.py")
    inside = sum(package_of(room) == package_of(other) for room, others in imports.items() for other in others)
    print(f"{len(imports)} rooms, {inside} imports within packages, no circle, none upwards")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
