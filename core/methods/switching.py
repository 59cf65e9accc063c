"""Our default method: windowed strain and pair distances, switching k-means, refined cuts."""

import numpy as np
from threadpoolctl import threadpool_limits

from core.analysis import Analysis, Features
from core.document import Notice, Score
from core.keyframes import key_frames
from core.parameters import Auto, Parameters
from core.refinement import refined
from core.segmentation import Cut
from core.switching.blur import without_blur
from core.switching.certainty import certainty
from core.switching.choice import choose
from core.switching.consensus import WEIGHTINGS, most_agreed
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
        settled, scores = _motions(signal, parameters)
        motions = settled.motions if parameters.motions == "auto" else parameters.motions
        signal, settled = _agreed(features, signal, settled, motions, analysis.frame_rate)
        labels = refined(signal.per_frame(settled.labels), features, analysis.frame_rate)
        sure = certainty(signal, settled, _penalty(signal))
    return Cut(labels, keys, sure, scores, _fewer(parameters.motions, settled.motions))


def _motions(signal: Signal, parameters: Parameters) -> tuple[Settled, tuple[Score, ...]]:
    """The motions by all descriptors alike, and what is left unexplained by each number of them."""
    if parameters.motions != "auto":
        return _told(signal, parameters.motions), ()
    choice = choose(signal, Stretches.of(signal, _penalty(signal)), _penalty(signal))
    scores = tuple(Score(motions=k, score=round(s, 6)) for k, s in choice.scores)
    return without_blur(signal, choice.settled), scores


def _agreed(
    features: tuple[Features, ...], signal: Signal, settled: Settled, motions: int, frame_rate: float
) -> tuple[Signal, Settled]:
    """The same number of motions by that weighting of the descriptors with which the others agree most."""
    found = [(signal, settled)]
    for weights in WEIGHTINGS[1:] if len(features) == len(WEIGHTINGS[0]) and motions > 1 else ():
        other = windowed_signal(features, signal.frames, frame_rate, weights)
        if other is not None:
            found.append((other, _told(other, motions)))
    return found[most_agreed([solution.labels for _, solution in found])]


def _told(signal: Signal, motions: int) -> Settled:
    penalty = _penalty(signal)
    stretches = Stretches.of(signal, penalty, at_least=motions)
    return without_blur(signal, settle(signal.values, stretches.grouped(motions), penalty))


def _penalty(signal: Signal) -> float:
    return CHANGE_SECONDS / signal.seconds_per_step


def _fewer(asked: Auto | int, found: int) -> tuple[Notice, ...]:
    if asked in ("auto", found):
        return ()
    detail = f"{asked} motions were asked for, but only {found} differ: that many it is."
    return (Notice(code="fewer-motions", detail=detail),)
