"""The part of the default method that cuts a sheet: a timeline of clips laid end to end, each a motion of its own."""

from dataclasses import dataclass, replace

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.methods.sheets.clip_division import CLIP, Division, Timeline
from caesura.core.methods.sheets.sheet_detection import is_clip_sheet
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut
from caesura.core.segmentation_document import Notice

LEAST = 0.1
"""Candidates that are less likely are not listed."""


@dataclass(frozen=True)
class Sheet:
    """A take as a timeline of clips, its best division, and whether it looks like one."""

    timeline: Timeline
    division: Division
    recognised: bool

    @classmethod
    def of(cls, analysis: Analysis) -> "Sheet | None":
        """None where nothing moves, or where the take is too short or too long for a sheet."""
        timeline = Timeline.of(analysis)
        if timeline is None:
            return None
        timeline = timeline.without_arcs(timeline.divided())
        division = timeline.divided()
        return cls(timeline, division, is_clip_sheet(timeline, division))


def cut_sheet(analysis: Analysis, parameters: Parameters, cut: Cut) -> Cut | None:
    """`cut` with the clips of a sheet; None where the take is a performance, by what it looks like or what was said.

    What lies between two clips is a transition, and is divided in its middle.
    """
    sheet = None if parameters.expect == "performance" else analysis.derived(Sheet.of)
    if sheet is None or not (sheet.recognised or parameters.expect == "sheet"):
        return None
    auto = parameters.motions == "auto"
    division = sheet.division if auto else sheet.timeline.divided(int(parameters.motions))
    starts, ends = division.starts, division.ends
    bounds = np.concatenate([[0], (ends[:-1] + starts[1:]) // 2, [analysis.frames]])
    between = zip([0, *ends.tolist()], [*starts.tolist(), analysis.frames], strict=True)
    return replace(
        cut,
        labels=np.repeat(np.arange(len(starts)), np.diff(bounds)),
        confidence=division.gains / (division.gains + CLIP),
        notices=_notices(parameters, len(starts)),
        kind="sheet",
        transitions=tuple((start, end) for start, end in between if start < end),
        candidates=_candidates(sheet.timeline, division),
    )


def _candidates(timeline: Timeline, division: Division) -> tuple[tuple[int, float], ...]:
    """Where a clip is nearly better off as two, and how likely it is two, the likeliest first."""
    frames, gains = timeline.best_splits(division)
    likely = gains / (gains + CLIP)
    order = np.argsort(-likely, kind="stable")
    return tuple((int(frames[i]), float(likely[i])) for i in order if likely[i] >= LEAST)


def _notices(parameters: Parameters, clips: int) -> tuple[Notice, ...]:
    said = () if parameters.expect == "sheet" else (_sheet_notice(clips),)
    if parameters.motions in ("auto", clips):
        return said
    detail = f"{parameters.motions} clips were asked for, but clips last 0.3 to 15 seconds here: {clips} it is."
    return (*said, Notice(code="other-number-of-clips", detail=detail))


def _sheet_notice(clips: int) -> Notice:
    detail = (
        f"The take was read as a sheet of {clips} clips laid end to end: most of them end in the pose in which they"
        " begin, and few are there twice. If it is one performance, send expect=performance."
    )
    return Notice(code="taken-for-a-sheet", detail=detail)
