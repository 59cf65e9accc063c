"""The numbers of an AMC: for every frame and bone what its skeleton says that it is free in."""

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import cycle, islice, pairwise

import numpy as np
from jaxtyping import Float

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.asf.amc_header import AmcHead, malformed_amc, read_amc_head

PIECE = 2**22
"""Bytes of text that are taken apart at a time."""

NAME = re.compile(rb"(?<!\S)[A-Za-z_][^\s]*")
FARTHEST = 1e15


@dataclass(frozen=True)
class Motion:
    """The numbers of each bone that moves, (frames, freedoms), and what the head says."""

    head: AmcHead
    values: dict[str, Float[np.ndarray, "frames freedoms"]]


def read_motion(data: memoryview, limits: Limits) -> Motion:
    """The motion of an AMC; raises `BrokenContainer("malformed-amc")`, `InvalidModel` or `LimitExceeded`.

    Every frame must name the bones of the first one in their order.
    """
    head = read_amc_head(bytes(data[:PIECE]))
    layout = _first_frame(bytes(data[head.start : head.start + PIECE]))
    columns = 1 + sum(layout.values())
    expected, names = list(layout), 0
    pieces: list[Float[np.ndarray, "_"]] = []
    for text in _pieces(data[head.start :]):
        found = [name.decode("latin1") for name in NAME.findall(text)]
        turn = names % len(expected)
        if found != list(islice(cycle(expected), turn, turn + len(found))):
            raise malformed_amc("does not name the same bones in every frame")
        names += len(found)
        pieces.append(_numbers(NAME.sub(b" ", text)))
        limits.check("max_frames", names // len(expected), "Cut the take")
    numbers = np.concatenate(pieces)
    if len(numbers) % columns or len(numbers) // columns * len(expected) != names:
        raise malformed_amc("has other numbers of values in some frames than in its first")
    rows = numbers.reshape(-1, columns)
    if (np.diff(rows[:, 0]) != 1).any():
        raise malformed_amc("leaves frames out, or has a value too many in one")
    usable = (np.abs(rows) < FARTHEST).all(axis=1)
    if not usable.all():
        frame = int(np.argmin(usable))
        raise InvalidModel("non-finite-data", "A number of the motion is not finite.", frame=frame)
    ends = np.cumsum([1, *layout.values()]).tolist()
    return Motion(head, {name: rows[:, a:b] for name, (a, b) in zip(layout, pairwise(ends), strict=True)})


def _first_frame(text: bytes) -> dict[str, int]:
    """The bones of the first frame, and how many numbers each has there."""
    layout: dict[str, int] = {}
    for line in text.splitlines()[1:]:
        words = line.split()
        if len(words) == 1 and words[0].isdigit():
            break
        if words:
            name = words[0].decode("latin1")
            if name in layout or not NAME.fullmatch(words[0]):
                raise malformed_amc(f"has {name[:40]!r} where a bone belongs, or twice in a frame")
            layout[name] = len(words) - 1
    if not layout:
        raise malformed_amc("has no bones in its first frame")
    return layout


def _pieces(data: memoryview) -> Iterator[bytes]:
    """The text in parts that end with a line."""
    at = 0
    while at < len(data):
        piece = bytes(data[at : at + PIECE])
        whole = piece.rfind(b"\n") + 1 if at + PIECE < len(data) else 0
        yield piece[: whole or None]
        at += whole or len(piece)


def _numbers(text: bytes) -> Float[np.ndarray, "numbers"]:
    if not text.strip():
        return np.zeros(0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, np.float64, sep=" ")
        except (ValueError, DeprecationWarning):
            raise malformed_amc("has something that is no number among its values") from None
