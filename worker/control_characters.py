"""Control characters: in a terminal or a log they act instead of being shown."""

import re

CONTROL = re.compile("[\0-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Those of ASCII and ISO 8859-1, ends of lines and paragraphs, and marks that turn the direction of writing."""


def escape_control_characters(text: str) -> str:
    r"""The text, with each control character as Python writes it: `\n`, `\x1b`, `\u202e`."""
    return CONTROL.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)
