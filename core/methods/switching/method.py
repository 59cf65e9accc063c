"""Our default method: a sheet is cut at its clips, a performance by switching k-means in several views."""

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.energy.key_frames import extract_key_frames
from caesura.core.methods.sheets.method import cut_sheet
from caesura.core.methods.switching.cut_confidence import cut_confidence
from caesura.core.methods.switching.labellings import Labellings
from caesura.core.methods.switching.missed_cuts import find_missed_cuts
from caesura.core.methods.switching.motion_count import MotionCountSearch
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.views import Frames, Views
from caesura.core.parameters import Auto, Parameters
from caesura.core.segmentation import Cut
from caesura.core.segmentation_document import Notice, Score
from caesura.core.single_threaded_blas import single_threaded_blas

LONG = 3000
"""Frames from which on threads gain more than it takes to start them."""


def switching(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its motion changes, and say which motions are the same. Nothing changes: one segment."""
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = extract_key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    with single_threaded_blas():
        sheet = cut_sheet(analysis, parameters, Cut(np.zeros(analysis.frames, np.int64), keys))
        if sheet is not None:
            return sheet
        labellings = analysis.derived(_labellings)
        views = labellings.views
        if not views.names:
            notices = _fewer_motions_notice(parameters.motions, 1)
            return Cut(np.zeros(analysis.frames, np.int64), keys, np.zeros(0), notices=notices)
        auto = parameters.motions == "auto"
        search = MotionCountSearch(labellings)
        found = search.choose() if auto else search.of(int(parameters.motions))
        viewed = views.by(found.view)
        sure = cut_confidence(viewed.signal, found.labels, viewed.penalty) * labellings.refinement.clearness(
            found.labels
        )
    scores = tuple(Score(motions=k, score=round(s, 6)) for k, s in search.scores()) if auto else ()
    frame = views.frames.frame
    missed = find_missed_cuts(found, search.found.values(), views.frames.frame_rate)
    return Cut(
        views.frames.per_frame(found.labels),
        keys,
        np.sqrt(sure),
        scores,
        _fewer_motions_notice(parameters.motions, found.motions),
        transitions=tuple((frame(start), frame(end)) for start, end in found.transitions),
        candidates=tuple((frame(at), likely) for at, likely in missed),
    )


def _labellings(analysis: Analysis) -> Labellings:
    frames = Frames.of(analysis)
    refinement = Refinement.of(frames.values, frames.frame_rate)
    return Labellings(Views(frames), refinement, analysis.threads if frames.count >= LONG else 1)


def _fewer_motions_notice(asked: Auto | int, found: int) -> tuple[Notice, ...]:
    if asked in ("auto", found):
        return ()
    detail = f"{asked} motions were asked for, but only {found} differ: that many it is."
    return (Notice(code="fewer-motions", detail=detail),)
