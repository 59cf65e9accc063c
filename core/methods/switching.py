"""Our default method: windowed strain and pair distances, switching k-means, refined cuts."""

import numpy as np
from threadpoolctl import threadpool_limits

from core.analysis import Analysis
from core.document import Notice, Score
from core.keyframes import key_frames
from core.parameters import Auto, Parameters
from core.refinement import refined
from core.segmentation import Cut
from core.switching.blur import without_blur
from core.switching.certainty import certainty
from core.switching.choice import choose
from core.switching.settling import Settled, settle
from core.switching.signal import Signal, windowed_signal
from core.switching.stretches import Stretches

CHANGE_SECONDS = 1 / 3
"""What a change of motion costs: as much as a third of a second at the mean distance from the mean of all."""


def switching(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its motion changes, and say which motions are the same. Nothing changes: one segment."""
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    features = tuple(feature for feature in analysis.features if feature.values.shape[1])
    with threadpool_limits(1):
        signal = windowed_signal(features, analysis.frames, analysis.frame_rate)
        if signal is None:
            notices = _fewer(parameters.motions, 1)
            return Cut(np.zeros(analysis.frames, np.int64), keys, np.zeros(0), notices=notices)
        penalty = CHANGE_SECONDS / signal.seconds_per_step
        settled, scores = _motions(signal, penalty, parameters)
        settled = without_blur(signal, settled)
        labels = refined(signal.per_frame(settled.labels), features, analysis.frame_rate)
    return Cut(labels, keys, certainty(signal, settled, penalty), scores, _fewer(parameters.motions, settled.motions))


def _motions(signal: Signal, penalty: float, parameters: Parameters) -> tuple[Settled, tuple[Score, ...]]:
    if parameters.motions == "auto":
        choice = choose(signal, Stretches.of(signal, penalty), penalty)
        return choice.settled, tuple(Score(motions=k, score=round(s, 6)) for k, s in choice.scores)
    stretches = Stretches.of(signal, penalty, at_least=parameters.motions)
    return settle(signal.values, stretches.grouped(parameters.motions), penalty), ()


def _fewer(asked: Auto | int, found: int) -> tuple[Notice, ...]:
    if asked in ("auto", found):
        return ()
    detail = f"{asked} motions were asked for, but only {found} differ: that many it is."
    return (Notice(code="fewer-motions", detail=detail),)
