"""The paper's method: key-frames of the energy curve, K-means on their strain, boundaries by Eq. 5."""

from dataclasses import replace

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.energy.key_frames import extract_key_frames
from caesura.core.methods.joint_entropy.boundaries import label_frames_between_keys
from caesura.core.methods.joint_entropy.clustering import (
    KeyFrameClusters,
    cluster_key_frames,
    cluster_with_chosen_count,
    count_distinct,
)
from caesura.core.methods.joint_entropy.details import mean_strains, variances_between
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut
from caesura.core.segmentation_document import Notice, Score


def joint_entropy(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take as the paper does. No key-frame: one segment. Fewer different key-frames than K: K is their number."""
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = extract_key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    if len(keys) == 0:
        notice = Notice(code="no-key-frames", detail="The energy curve has no peak, so the take is one segment.")
        return Cut(np.zeros(analysis.frames, np.int64), keys, np.zeros(0), notices=(notice,))
    strain = analysis.peak_strain[np.searchsorted(analysis.peaks, keys)]
    clusters, scores, notices = _clusters(strain, parameters)
    labels = label_frames_between_keys(analysis.energy, keys, clusters.labels)
    changes = np.flatnonzero(np.diff(clusters.labels))
    confidence = np.minimum(clusters.margin[changes], clusters.margin[changes + 1])
    cut = Cut(labels, keys, confidence, scores, notices)
    if not parameters.details:
        return cut
    return replace(
        cut,
        variances=variances_between(analysis, keys, clusters.labels),
        clusters=mean_strains(analysis, keys, clusters.labels),
    )


def _clusters(
    strain: np.ndarray, parameters: Parameters
) -> tuple[KeyFrameClusters, tuple[Score, ...], tuple[Notice, ...]]:
    if parameters.motions == "auto":
        clusters, scores = cluster_with_chosen_count(strain, parameters.seed)
        return clusters, scores, ()
    possible = min(parameters.motions, count_distinct(strain))
    notices: tuple[Notice, ...] = ()
    if possible < parameters.motions:
        detail = f"{parameters.motions} motions were asked for, but only {possible} key-frames differ: that many it is."
        notices = (Notice(code="fewer-motions", detail=detail),)
    return cluster_key_frames(strain, possible, parameters.seed), (), notices
