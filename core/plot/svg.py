"""A picture as SVG: text, the same for the same picture."""

import re
from xml.sax.saxutils import escape

from caesura.core.plot.picture import TEXT, Box, Dot, Label, Line, Picture

FORBIDDEN_CHARACTERS = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML 1.0 has no way to write."""


def render_svg(picture: Picture) -> str:
    """The picture, on white, to be pasted into a paper."""
    size = f'width="{picture.width}" height="{picture.height}" viewBox="0 0 {picture.width} {picture.height}"'
    look = f'font-family="Helvetica, Arial, sans-serif" font-size="{TEXT}"'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} {look} role="img">',
        f"<title>{plain_text(picture.title)}</title>",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
        *map(_shape, picture.shapes),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def plain_text(text: str) -> str:
    """Text that is nothing but text in XML."""
    return escape(FORBIDDEN_CHARACTERS.sub("", text))


def _shape(shape: Box | Line | Dot | Label) -> str:
    match shape:
        case Box(x, y, width, height, fill):
            sides = f'x="{_decimal(x)}" y="{_decimal(y)}" width="{_decimal(width)}" height="{_decimal(height)}"'
            return f'<rect {sides} fill="{fill}"/>'
        case Line(points, colour, width, dashed):
            dash = ' stroke-dasharray="3 3"' if dashed else ""
            path = " ".join(f"{_decimal(x)},{_decimal(y)}" for x, y in points)
            return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{_decimal(width)}"{dash}/>'
        case Dot((x, y), radius, fill):
            return f'<circle cx="{_decimal(x)}" cy="{_decimal(y)}" r="{_decimal(radius)}" fill="{fill}"/>'
        case Label((x, y), text, colour, anchor):
            turn = f' transform="rotate(-90 {_decimal(x)} {_decimal(y)})"' if shape.upright else ""
            place = f'x="{_decimal(x)}" y="{_decimal(y)}" text-anchor="{anchor}"'
            return f'<text {place} fill="{colour}"{turn}>{plain_text(text)}</text>'


def _decimal(number: float) -> str:
    return f"{number:.2f}".rstrip("0").rstrip(".")
