"""Our default method: windowed strain and pair distances, switching k-means, refined cuts."""

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.document import Notice, Score
from caesura.core.energy.key_frames import key_frames
from caesura.core.methods.switching.consensus import WEIGHTINGS, most_agreed
from caesura.core.methods.switching.cut_confidence import certainty
from caesura.core.methods.switching.feature_weights import Weighed, Weighings
from caesura.core.methods.switching.motion_count import choose
from caesura.core.methods.switching.refinement import refined
from caesura.core.methods.switching.short_segments import without_blur
from caesura.core.methods.switching.switching_k_means import Settled, settle
from caesura.core.parameters import Auto, Parameters
from caesura.core.segmentation import Cut
from caesura.core.single_threaded_blas import one_thread


def switching(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its motion changes, and say which motions are the same. Nothing changes: one segment."""
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    features = tuple(feature for feature in analysis.features if feature.values.shape[1])
    with one_thread():
        weighings = analysis.once(Weighings.of)
        alike = weighings.by()
        if alike is None:
            notices = _fewer(parameters.motions, 1)
            return Cut(np.zeros(analysis.frames, np.int64), keys, np.zeros(0), notices=notices)
        settled, scores = _motions(alike, parameters)
        motions = settled.motions if parameters.motions == "auto" else parameters.motions
        weighed, settled = _agreed(weighings, alike, settled, motions)
        found = refined(weighed.signal.per_frame(settled.labels), features, analysis.frame_rate)
        sure = np.sqrt(certainty(weighed.signal, settled, weighed.penalty) * found.clearness)
    return Cut(found.labels, keys, sure, scores, _fewer(parameters.motions, settled.motions))


def _motions(alike: Weighed, parameters: Parameters) -> tuple[Settled, tuple[Score, ...]]:
    """The motions by all descriptors alike, and what is left unexplained by each number of them."""
    if parameters.motions != "auto":
        return _told(alike, parameters.motions), ()
    choice = choose(alike.signal, alike.stretches, alike.penalty)
    scores = tuple(Score(motions=k, score=round(s, 6)) for k, s in choice.scores)
    return without_blur(alike.signal, choice.settled), scores


def _agreed(weighings: Weighings, alike: Weighed, settled: Settled, motions: int) -> tuple[Weighed, Settled]:
    """The same number of motions by that weighting of the descriptors with which the others agree most."""
    found = [(alike, settled)]
    for weights in WEIGHTINGS[1:] if weighings.descriptors == len(WEIGHTINGS[0]) and motions > 1 else ():
        other = weighings.by(weights)
        if other is not None:
            found.append((other, _told(other, motions)))
    return found[most_agreed([solution.labels for _, solution in found])]


def _told(weighed: Weighed, motions: int) -> Settled:
    means = weighed.at_least(motions).grouped(motions)
    return without_blur(weighed.signal, settle(weighed.signal.values, means, weighed.penalty))


def _fewer(asked: Auto | int, found: int) -> tuple[Notice, ...]:
    if asked in ("auto", found):
        return ()
    detail = f"{asked} motions were asked for, but only {found} differ: that many it is."
    return (Notice(code="fewer-motions", detail=detail),)
