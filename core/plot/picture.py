"""What a picture is made of. Pixels, x to the right and y down; colours as #rrggbb. Light: no NumPy."""

from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]
Anchor = Literal["start", "middle", "end"]


@dataclass(frozen=True)
class Box:
    """A filled rectangle, from its upper left corner."""

    x: float
    y: float
    width: float
    height: float
    fill: str


@dataclass(frozen=True)
class Line:
    """Straight strokes from point to point; `dashed` ones are vertical or horizontal."""

    points: tuple[Point, ...]
    colour: str
    width: float = 1.0
    dashed: bool = False


@dataclass(frozen=True)
class Dot:
    """A filled circle."""

    at: Point
    radius: float
    fill: str


@dataclass(frozen=True)
class Label:
    """Text on one line, `at` its baseline; `upright` is turned a quarter to the left.

    `spare` is what to write where the font has not all of its letters, even without their accents.
    """

    at: Point
    text: str
    colour: str
    anchor: Anchor = "middle"
    spare: str = ""
    upright: bool = False


@dataclass(frozen=True)
class Picture:
    """Shapes on white, in the order in which they are drawn. `title` is for who cannot see it."""

    width: int
    height: int
    title: str
    shapes: tuple[Box | Line | Dot | Label, ...]


TEXT = 13
"""Pixels, height of all text."""
