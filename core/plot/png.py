"""A picture as PNG, drawn by Pillow: the same pixels on every machine, but for names in a font that was handed in."""

import io

from PIL import Image, ImageDraw

from caesura.core.plot.font import LabelFont, LabelText
from caesura.core.plot.picture import TEXT, Box, Dot, Label, Line, Picture, Point

SCALE = 2
"""Pixels of the PNG for each of the picture: it is to be printed."""

SMOOTH = 3
"""Drawn so many times as large, for Pillow's strokes have hard edges, and made smaller at the end."""

DASH = 3.0
MISSING_LETTERS_DETAIL = "Names whose letters this font lacks are changed; see the SVG."
"""Written at the foot of a picture whose names are not what they were."""

FAINT, EDGE = "#5c5c5c", 8


def render_png(picture: Picture, font: bytes | None = None) -> bytes:
    """The picture, on white, twice as many pixels either way.

    Names that Pillow's own font cannot write are written in `font`, the content of a TrueType or OpenType file; the
    picture says below where letters of a name are missing all the same.
    """
    size = (picture.width * SCALE * SMOOTH, picture.height * SCALE * SMOOTH)
    canvas = Image.new("RGB", size, "#ffffff")
    pen = ImageDraw.Draw(canvas)
    for shape in picture.shapes:
        if not isinstance(shape, Label):
            _draw_shape(pen, shape, SCALE * SMOOTH)
    small = canvas.resize((picture.width * SCALE, picture.height * SCALE), Image.Resampling.BOX)
    lettering = LabelFont(TEXT * SCALE, font)
    written = [(label, lettering.of(label)) for label in picture.shapes if isinstance(label, Label)]
    if not all(one.whole for _, one in written):
        below = Label((picture.width - EDGE, picture.height - EDGE), MISSING_LETTERS_DETAIL, FAINT, "end")
        written.append((below, lettering.of(below)))
    for label, one in written:
        _write(small, label, one)
    out = io.BytesIO()
    small.save(out, "PNG", dpi=(96 * SCALE, 96 * SCALE))
    return out.getvalue()


def _draw_shape(pen: ImageDraw.ImageDraw, shape: Box | Line | Dot, scale: int) -> None:
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


def _write(image: Image.Image, label: Label, written: LabelText) -> None:
    text, font, _ = written
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
