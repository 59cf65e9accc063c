"""Our default method: windowed strain and pair distances, switching k-means, refined cuts."""

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.document import Notice, Score
from caesura.core.energy.key_frames import extract_key_frames
from caesura.core.methods.switching.consensus import WEIGHTINGS, find_consensus
from caesura.core.methods.switching.cut_confidence import cut_confidence
from caesura.core.methods.switching.feature_weights import WeightedTake, Weightings
from caesura.core.methods.switching.motion_count import choose_motion_count
from caesura.core.methods.switching.refinement import refine_cuts
from caesura.core.methods.switching.short_segments import remove_short_segments
from caesura.core.methods.switching.switching_k_means import SwitchingClusters, run_switching_k_means
from caesura.core.parameters import Auto, Parameters
from caesura.core.segmentation import Cut
from caesura.core.single_threaded_blas import single_threaded_blas


def switching(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its motion changes, and say which motions are the same. Nothing changes: one segment."""
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = extract_key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    features = tuple(feature for feature in analysis.features if feature.values.shape[1])
    with single_threaded_blas():
        weighings = analysis.once(Weightings.of)
        alike = weighings.by()
        if alike is None:
            notices = _fewer_motions_notice(parameters.motions, 1)
            return Cut(np.zeros(analysis.frames, np.int64), keys, np.zeros(0), notices=notices)
        settled, scores = _find_motions(alike, parameters)
        motions = settled.motions if parameters.motions == "auto" else parameters.motions
        weighed, settled = _find_agreed_weighting(weighings, alike, settled, motions)
        found = refine_cuts(weighed.signal.per_frame(settled.labels), features, analysis.frame_rate)
        sure = np.sqrt(cut_confidence(weighed.signal, settled, weighed.penalty) * found.clearness)
    return Cut(found.labels, keys, sure, scores, _fewer_motions_notice(parameters.motions, settled.motions))


def _find_motions(alike: WeightedTake, parameters: Parameters) -> tuple[SwitchingClusters, tuple[Score, ...]]:
    """The motions by all descriptors alike, and what is left unexplained by each number of them."""
    if parameters.motions != "auto":
        return _cut_into(alike, parameters.motions), ()
    choice = choose_motion_count(alike.signal, alike.stretches, alike.penalty)
    scores = tuple(Score(motions=k, score=round(s, 6)) for k, s in choice.scores)
    return remove_short_segments(alike.signal, choice.settled), scores


def _find_agreed_weighting(
    weighings: Weightings, alike: WeightedTake, settled: SwitchingClusters, motions: int
) -> tuple[WeightedTake, SwitchingClusters]:
    """The same number of motions by that weighting of the descriptors with which the others agree most."""
    found = [(alike, settled)]
    for weights in WEIGHTINGS[1:] if weighings.descriptors == len(WEIGHTINGS[0]) and motions > 1 else ():
        other = weighings.by(weights)
        if other is not None:
            found.append((other, _cut_into(other, motions)))
    return found[find_consensus([solution.labels for _, solution in found])]


def _cut_into(weighed: WeightedTake, motions: int) -> SwitchingClusters:
    means = weighed.at_least(motions).grouped(motions)
    return remove_short_segments(weighed.signal, run_switching_k_means(weighed.signal.values, means, weighed.penalty))


def _fewer_motions_notice(asked: Auto | int, found: int) -> tuple[Notice, ...]:
    if asked in ("auto", found):
        return ()
    detail = f"{asked} motions were asked for, but only {found} differ: that many it is."
    return (Notice(code="fewer-motions", detail=detail),)
