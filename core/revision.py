"""A revision: the segments as a person has set them, checked, and the result as it reads with them.

The computed result stays as it is; a revision is a layer over it. Light: no NumPy.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from unicodedata import normalize

from pydantic import BaseModel, ConfigDict, Field

from caesura.core.errors import ParameterError
from caesura.core.segmentation_document import Interval, KeyFrame, Loop, Segment, SegmentationDocument, motion_name

LONGEST_NAME = 100
JOINERS = "\u200c\u200d"
"""Zero-width non-joiner and joiner: Persian, Hindi and others are not written without them."""


class Edit(BaseModel):
    """One segment as a person set it: frames [start, end) of a motion. An empty `name` is the next free letter."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    start: int = Field(ge=0, lt=2**53)
    end: int = Field(ge=0, lt=2**53)
    motion: int = Field(gt=-(2**53), lt=2**53, description="any number, the same for the same motion")
    name: str | None = Field(None, description="the motion's name; the next free letter where none is given")
    loop: bool = Field(False, description="its clip goes round")
    discard: bool = Field(False, description="it is to be no clip")


def check_edits(edits: Sequence[Edit], frames: int) -> tuple[Edit, ...]:
    """The same with motions 0, 1, … by first appearance, and the name of its motion on each.

    Raises `ParameterError` ("invalid-segments"), with a pointer to the first fault, where they do not tile
    [0, frames), where a name is no name, or where names and motions do not go together one to one.
    """
    _check_tiling(edits, frames)
    names = _names(edits)
    ranks = {motion: rank for rank, motion in enumerate(names)}
    return tuple(edit.model_copy(update={"motion": ranks[edit.motion], "name": names[edit.motion]}) for edit in edits)


def apply_revision(
    document: SegmentationDocument, number: int, edits: Sequence[Edit], loops: Sequence[Loop | None] | None = None
) -> SegmentationDocument:
    """The computed result with the `checked` segments of revision `number` in place of its own.

    Cuts that did not move keep their confidence; key-frames are of the motion that they are in now. `loops` are the
    best of each segment, where they were searched; else a segment keeps the best of those that lie within it.
    """
    sure = {segment.end: segment.confidence for segment in document.segments}
    known = loops or tuple(_kept_loop(document.segments, edit) for edit in edits)
    segments = tuple(
        _revised_segment(document, edit, sure.get(edit.end), loop) for edit, loop in zip(edits, known, strict=True)
    )
    return document.model_copy(
        update={
            "revision": number,
            "motions": len({edit.motion for edit in edits}),
            "segments": segments,
            "key_frames": tuple(_assign_key_frames(document.key_frames, segments)),
        }
    )


def _revised_segment(
    document: SegmentationDocument, edit: Edit, confidence: float | None, loop: Loop | None
) -> Segment:
    begin, rate = document.source.start_seconds, document.frame_rate
    return Segment(
        start=edit.start,
        end=edit.end,
        start_seconds=begin + edit.start / rate,
        end_seconds=begin + min(edit.end, document.frames - 1) / rate,
        motion=edit.motion,
        name=edit.name or motion_name(edit.motion),
        repeats=kept_repeats(document.segments, edit),
        best_loop=loop,
        confidence=confidence,
        loop=edit.loop,
        discard=edit.discard,
    )


def kept_repeats(before: Iterable[Segment], edit: Edit) -> tuple[Interval, ...]:
    """Those of the segment that it was cut from or stretched from; none where several have become one."""
    within = [s for s in before if edit.start <= s.start and s.end <= edit.end]
    touched = within or [s for s in before if s.start < edit.end and edit.start < s.end]
    origin = max(touched, key=lambda s: min(s.end, edit.end) - max(s.start, edit.start))
    if len(within) > 1 or not origin.repeats:
        return ()
    inner = [r.start for r in origin.repeats[1:] if edit.start < r.start < edit.end]
    bounds = [edit.start, *inner, edit.end]
    return tuple(Interval(start=a, end=b) for a, b in pairwise(bounds))


def _kept_loop(before: Iterable[Segment], edit: Edit) -> Loop | None:
    """The best that lies within the segment as it is now."""
    loops = (segment.best_loop for segment in before if segment.best_loop is not None)
    kept = [loop for loop in loops if edit.start <= loop.start and loop.end <= edit.end]
    return min(kept, key=lambda loop: loop.seam, default=None)


def _assign_key_frames(keys: Iterable[KeyFrame], segments: Sequence[Segment]) -> Iterable[KeyFrame]:
    """Key-frames and segments both come in order, so one walk finds each key-frame's segment."""
    place = 0
    for key in keys:
        while segments[place].end <= key.frame:
            place += 1
        yield key.model_copy(update={"motion": segments[place].motion})


def _check_tiling(edits: Sequence[Edit], frames: int) -> None:
    at = 0
    for number, edit in enumerate(edits):
        if edit.start != at:
            what = "overlaps the one before" if edit.start < at else "leaves frames out before it"
            _invalid_edit(
                f"Segment {number} begins at frame {edit.start} and {what}: it must begin at {at}.", number, "start"
            )
        if edit.end <= edit.start:
            _invalid_edit(f"Segment {number} ends at frame {edit.end}: it must have a frame at least.", number, "end")
        at = edit.end
        if at > frames:
            _invalid_edit(f"Segment {number} ends at frame {at}, but the take has {frames} frames.", number, "end")
    if at != frames:
        detail = f"The segments end at frame {at}, but the take has {frames} frames: they must reach its end."
        raise ParameterError(
            "invalid-segments", detail, pointer=f"/segments/{len(edits) - 1}/end" if edits else "/segments"
        )


def _names(edits: Sequence[Edit]) -> dict[int, str]:
    """The name of each motion, in order of first appearance."""
    named: dict[int, str] = {}
    whose: dict[str, int] = {}
    for number, edit in enumerate(edits):
        if edit.name is None:
            continue
        _check_name(edit.name, number)
        if named.setdefault(edit.motion, edit.name) != edit.name:
            detail = f"Motion {edit.motion} is called {named[edit.motion]!r} and {edit.name!r}. Give it one name."
            _invalid_edit(detail, number, "name")
        if whose.setdefault(edit.name, edit.motion) != edit.motion:
            both = f"Motions {whose[edit.name]} and {edit.motion} are both called {edit.name!r}."
            _invalid_edit(f"{both} Make them one motion, or name one anew.", number, "name")
    letters = (letter for letter in map(motion_name, range(2 * len(edits))) if letter not in whose)
    return {motion: named.get(motion) or next(letters) for motion in dict.fromkeys(edit.motion for edit in edits)}


def _check_name(name: str, number: int) -> None:
    """A name that can be shown, typed and put into any file: a line of text that no spreadsheet takes for a formula."""
    if not name.strip(JOINERS) or name != name.strip():
        _invalid_edit(f"The name of segment {number} is empty, or begins or ends with a space.", number, "name")
    if len(name) > LONGEST_NAME:
        _invalid_edit(f"The name of segment {number} is longer than {LONGEST_NAME} letters.", number, "name")
    odd = next((letter for letter in name if not letter.isprintable() and letter not in JOINERS), None)
    if odd is not None:
        _invalid_edit(f"The name of segment {number} holds U+{ord(odd):04X}, which does not print.", number, "name")
    if normalize("NFKC", name[0])[0] in "=+-@":
        _invalid_edit(
            f"The name of segment {number} begins with {name[0]}: spreadsheets take that for a formula.", number, "name"
        )


def _invalid_edit(detail: str, number: int, member: str) -> None:
    raise ParameterError("invalid-segments", detail, pointer=f"/segments/{number}/{member}")
