"""Which font writes a label: Pillow's own, which has plain letters alone, or one that was handed in."""

import io
from typing import NamedTuple
from unicodedata import combining, normalize

from PIL import ImageFont

from caesura.core.errors import ParameterError
from caesura.core.plot.picture import Label

MISSING = "\uffff"
"""No font has this letter, so it is drawn as letters are that a font lacks."""

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont


class LabelText(NamedTuple):
    """What is written for a label, in which font, and whether that is all that it says."""

    text: str
    font: Font
    whole: bool


class LabelFont:
    """Fonts of one size in pixels; Pillow's own comes first, so that plain names look alike on every machine.

    `font` is the content of a TrueType or OpenType file for all other names. Raises `ParameterError` where it is none.
    """

    def __init__(self, size: int, font: bytes | None = None) -> None:
        self._fonts: list[Font] = [ImageFont.load_default(size)]
        if font is not None:
            self._fonts.append(_open_font(font, size))

    @property
    def plain(self) -> Font:
        """Pillow's own."""
        return self._fonts[0]

    def of(self, label: Label) -> LabelText:
        """The label as it is if a font has all of it, else without accents, else its spare."""
        bare = "".join(letter for letter in normalize("NFKD", label.text) if not combining(letter))
        for text in (label.text, bare):
            for font in self._fonts:
                if _font_has(font, text):
                    return LabelText(text, font, text == label.text)
        return LabelText(label.spare, self.plain, False)


def _open_font(content: bytes, size: int) -> Font:
    try:
        return ImageFont.truetype(io.BytesIO(content), size)
    except OSError as error:
        detail = f"The font for plots cannot be read ({error}). Give a .ttf or .otf file."
        raise ParameterError("invalid-parameter", detail, parameter="font") from error


def _font_has(font: Font, text: str) -> bool:
    """Whether the font has every letter."""
    lacking = bytes(font.getmask(MISSING))
    return all(letter.isspace() or bytes(font.getmask(letter)) != lacking for letter in set(text))
