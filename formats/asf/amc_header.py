"""The header of an AMC: what it says before its first frame, and how many frames follow. Light: no NumPy."""

import re
from dataclasses import dataclass
from typing import BinaryIO

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits
from caesura.formats.file_type import Format
from caesura.formats.upload_summary import Header, HeaderTake

LONGEST_HEAD = 2**16
FRAME_NUMBER = re.compile(rb"^[ \t]*(\d{1,9})[ \t\r]*$", re.MULTILINE)
RATE = re.compile(rb"^:SAMPLES-PER-SECOND\s+([\d.]{1,20})", re.MULTILINE | re.IGNORECASE)
RADIANS = re.compile(rb"^:RADIANS\b", re.MULTILINE | re.IGNORECASE)
DEGREES = re.compile(rb"^:DEGREES\b", re.MULTILINE | re.IGNORECASE)

CAPTURED = 120.0
"""Frames a second of most of the library that made the format known, CMU's; an AMC seldom says its own."""


@dataclass(frozen=True)
class AmcHead:
    """Frames, the first called `first`, begin at byte `start`; `rate` and `degrees` are None where it says nothing."""

    start: int
    first: int
    rate: float | None
    degrees: bool | None


def amc_header(file: BinaryIO, kind: Format, name: str, _limits: Limits) -> Header:
    """That of an AMC; its joints are in the ASF."""
    size = file.seek(0, 2)
    file.seek(0)
    head = read_amc_head(file.read(LONGEST_HEAD))
    file.seek(max(size - LONGEST_HEAD, head.start))
    last = _last_frame_number(file.read(LONGEST_HEAD))
    if last is None or last < head.first:
        return Header(kind, name)
    frames, rate = last - head.first + 1, head.rate or CAPTURED
    return Header(kind, name, (HeaderTake(0, "motion", (frames - 1) / rate, frames, rate),), None, 0)


def read_amc_head(data: bytes) -> AmcHead:
    """The head of an AMC that begins with `data`; raises `BrokenContainer("malformed-amc")`."""
    frame = FRAME_NUMBER.search(data[:LONGEST_HEAD])
    if frame is None:
        raise malformed_amc("has no frame: a line with its number and nothing else")
    text = data[: frame.start()]
    rate = RATE.search(text)
    value = _number(rate[1]) if rate else None
    degrees = True if DEGREES.search(text) else False if RADIANS.search(text) else None
    return AmcHead(frame.start(), int(frame[1]), value, degrees)


def _last_frame_number(tail: bytes) -> int | None:
    """The number of the last frame in the end of a file."""
    found = FRAME_NUMBER.findall(tail)
    return int(found[-1]) if found else None


def malformed_amc(what: str) -> BrokenContainer:
    """The refusal of an AMC."""
    return BrokenContainer("malformed-amc", f"The AMC {what}. Export it again.")


def _number(word: bytes) -> float:
    try:
        rate = float(word)
    except ValueError:
        rate = 0.0
    if not 1e-3 <= rate <= 1e6:
        raise malformed_amc(f"has {word[:20].decode('latin1')} samples a second")
    return rate
