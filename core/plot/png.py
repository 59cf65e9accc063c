"""A picture as PNG, drawn by Pillow with the font that it brings along: the same pixels on every machine."""

import io
from unicodedata import combining, normalize

from PIL import Image, ImageDraw, ImageFont

from core.plot.picture import TEXT, Box, Dot, Label, Line, Picture, Point

SCALE = 2
"""Pixels of the PNG for each of the picture: it is to be printed."""

SMOOTH = 3
"""Drawn so many times as large, for Pillow's strokes have hard edges, and made smaller at the end."""

DASH = 3.0
MISSING = "\uffff"
"""No font has this letter, so it is drawn as letters are that a font lacks."""

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont


def png(picture: Picture) -> bytes:
    """The picture, on white, twice as many pixels either way."""
    size = (picture.width * SCALE * SMOOTH, picture.height * SCALE * SMOOTH)
    canvas = Image.new("RGB", size, "#ffffff")
    pen = ImageDraw.Draw(canvas)
    for shape in picture.shapes:
        if not isinstance(shape, Label):
            _draw(pen, shape, SCALE * SMOOTH)
    small = canvas.resize((picture.width * SCALE, picture.height * SCALE), Image.Resampling.BOX)
    font = ImageFont.load_default(TEXT * SCALE)
    for label in picture.shapes:
        if isinstance(label, Label):
            _write(small, label, font)
    out = io.BytesIO()
    small.save(out, "PNG", dpi=(96 * SCALE, 96 * SCALE))
    return out.getvalue()


def _draw(pen: ImageDraw.ImageDraw, shape: Box | Line | Dot, scale: int) -> None:
    match shape:
        case Box(x, y, width, height, fill):
            corner = ((x + width) * scale - 1, (y + height) * scale - 1)
            if corner[0] >= x * scale:
                pen.rectangle(((x * scale, y * scale), corner), fill)
        case Line(points, colour, width, dashed):
            for stroke in _dashes(points) if dashed else [points]:
                pen.line([(x * scale, y * scale) for x, y in stroke], colour, round(width * scale), joint="curve")
        case Dot((x, y), radius, fill):
            pen.circle((x * scale, y * scale), radius * scale, fill)


def _dashes(points: tuple[Point, ...]) -> list[tuple[Point, Point]]:
    """The dashes of a vertical line."""
    (x, top), (_, bottom) = points
    starts = [top + 2 * DASH * number for number in range(int((bottom - top) // (2 * DASH)) + 1)]
    return [((x, y), (x, min(y + DASH, bottom))) for y in starts]


def _write(image: Image.Image, label: Label, font: Font) -> None:
    bare = "".join(letter for letter in normalize("NFKD", label.text) if not combining(letter))
    text = next((text for text in (label.text, bare) if _has(font, text)), label.spare)
    x, y = label.at[0] * SCALE, label.at[1] * SCALE
    if not label.upright:
        anchor = {"start": "ls", "middle": "ms", "end": "rs"}[label.anchor]
        ImageDraw.Draw(image).text((x, y), text, label.colour, font, anchor)
        return
    _, top, right, bottom = font.getbbox(text)
    ink = Image.new("L", (round(right), round(bottom + top)))
    ImageDraw.Draw(ink).text((0, 0), text, 255, font)
    turned = ink.transpose(Image.Transpose.ROTATE_90)
    image.paste(label.colour, (round(x - turned.width / 2), round(y - turned.height / 2)), turned)


def _has(font: Font, text: str) -> bool:
    """Whether the font has every letter."""
    lacking = bytes(font.getmask(MISSING))
    return all(letter.isspace() or bytes(font.getmask(letter)) != lacking for letter in set(text))
