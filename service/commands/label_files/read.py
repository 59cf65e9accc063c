"""The labels of a file, whatever its kind, and those of two files on the same frames."""

import json
import sys
from bisect import bisect
from collections.abc import Sequence
from pathlib import Path

from caesura.core.errors import InvalidModel, LimitExceeded
from caesura.service.commands.file_arguments import STANDARD
from caesura.service.commands.frame_labels import Labelling
from caesura.service.commands.label_files.csv_file import read_csv_labels
from caesura.service.commands.label_files.eaf_file import read_eaf_labels
from caesura.service.commands.label_files.timed_labels import END_FRAMES, TimedLabels

MOST_BYTES = 2**27
"""A document of a million frames has some 20 MB."""


def read_both(
    result: Path, truth: Path, *, tier: str | None = None, fps: float | None = None
) -> tuple[Labelling, Labelling]:
    """Both on the same frames: those of the one that states them, or at `fps` where neither does.

    Raises `InvalidModel` (`not-a-labelling`) or `LimitExceeded`.
    """
    return on_same_frames([(path, parse_labels(path, _read_content(path), tier)) for path in (result, truth)], fps)


def on_same_frames(
    found: Sequence[tuple[Path, Labelling | TimedLabels]], fps: float | None = None
) -> tuple[Labelling, Labelling]:
    """Two labellings on the frames of the one that states them, or at `fps`; see `read_both`."""
    stated = [one for _, one in found if isinstance(one, Labelling)]
    frames = stated[0] if stated else _longest(found, fps)
    one, other = (_on_frames(path, labels, frames) for path, labels in found)
    return one, other


def read_frame_labels(path: Path, take: Labelling, tier: str | None = None) -> list[str]:
    """The label of every frame of a take, of which only frames and rate matter; by time, whatever the labels' rate.

    Raises `InvalidModel` (`not-a-labelling`, `different-frames`) or `LimitExceeded`.
    """
    labels = parse_labels(path, _read_content(path), tier)
    known = _on_frames(path, labels, take)
    ratio = known.frame_rate / take.frame_rate
    if abs(known.frames - take.frames * ratio) > END_FRAMES * max(ratio, 1.0):
        detail = (
            f"{path} labels {known.frames} frames at {known.frame_rate:g} a second, and the take has {take.frames} at"
            f" {take.frame_rate:g}. Send the labels of this take, or --fps, --start and --end of what they are of."
        )
        raise InvalidModel("different-frames", detail)
    ends = [end for _, end, _ in known.segments]
    last = len(ends) - 1
    return [known.segments[min(bisect(ends, (frame + 0.5) * ratio), last)][2] for frame in range(take.frames)]


def _longest(found: Sequence[tuple[Path, Labelling | TimedLabels]], fps: float | None) -> Labelling:
    """The frames of labels that state no frame rate, at this one."""
    if fps is None:
        raise InvalidModel(
            "no-frame-rate", f"{' and '.join(str(path) for path, _ in found)} state no frame rate: give --fps."
        )
    longest = Labelling(fps, 0, ())
    for path, labels in found:
        try:
            if isinstance(labels, TimedLabels):
                longest = max(longest, labels.at(fps), key=lambda one: one.frames)
        except ValueError as wrong:
            raise _no_labelling(path, wrong) from None
    return longest


def _on_frames(path: Path, labels: Labelling | TimedLabels, frames: Labelling) -> Labelling:
    try:
        return labels.on_frames_of(frames) if isinstance(labels, TimedLabels) else labels
    except ValueError as wrong:
        raise _no_labelling(path, wrong) from None


def parse_labels(path: Path, content: bytes, tier: str | None = None) -> Labelling | TimedLabels:
    """The labels that a file holds, by its first letter: JSON, XML, or a table. Raises `InvalidModel`."""
    try:
        if content.lstrip()[:1] == b"<":
            return read_eaf_labels(content, tier)
        text = content.decode("utf-8-sig")
        return Labelling.of(json.loads(text)) if text.lstrip()[:1] in {"{", "["} else read_csv_labels(text)
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as wrong:
        raise _no_labelling(path, wrong) from None


def _read_content(path: Path) -> bytes:
    if path == STANDARD:
        content = sys.stdin.buffer.read(MOST_BYTES + 1)
    else:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    if len(content) > MOST_BYTES:
        detail = f"{path} is larger than the {MOST_BYTES} bytes that labels may have."
        raise LimitExceeded("limit-labels", detail, limit=MOST_BYTES)
    return content.removeprefix(b"\xef\xbb\xbf")


def _no_labelling(path: Path, wrong: Exception) -> InvalidModel:
    # Of text that is none, repr would show all of it.
    said = str(wrong) if isinstance(wrong, ValueError) else repr(wrong)
    detail = f"{path} is no segmentation document, truth, table or EAF that can be compared: {said[:300]}."
    return InvalidModel("not-a-labelling", detail)
