"""What the methods for comparison share: poses in, a motion for every frame out."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Int
from threadpoolctl import threadpool_limits

from caesura.core.analysis import Analysis
from caesura.core.energy.key_frames import extract_key_frames
from caesura.core.errors import ParameterError
from caesura.core.methods.pose_features import pose_features
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut
from caesura.core.segmentation_document import Notice

LabelFrames = Callable[[Float[np.ndarray, "frames D"], float, int, int], Int[np.ndarray, "frames"]]
"""Poses, frame rate, K and seed in; a motion for every frame out, of K or fewer."""


def cut_by_compared_method(analysis: Analysis, parameters: Parameters, divide: LabelFrames, most_frames: int) -> Cut:
    """Cut by `divide`. Nothing deforms: one segment. How sure a cut is, these methods do not say.

    Raises `ParameterError`: `motions-needed` where K is not given, `too-long-for-method` above `most_frames`, above
    which it would take minutes or gigabytes.
    """
    window = round(parameters.keyframe_window_seconds * analysis.frame_rate)
    keys = extract_key_frames(analysis.energy, analysis.peaks, window, parameters.threshold)
    values = pose_features(analysis.features)
    if values.shape[1] == 0:
        return Cut(np.zeros(analysis.frames, np.int64), keys)
    motions = parameters.required_motions()
    if analysis.frames > most_frames:
        raise ParameterError(
            "too-long-for-method",
            f"The method {parameters.method} takes at most {most_frames} frames; the take has {analysis.frames}."
            " Send a lower fps, or method=switching.",
            parameter="method",
            limit=most_frames,
            actual=analysis.frames,
        )
    if motions == 1:
        return Cut(np.zeros(analysis.frames, np.int64), keys)
    with threadpool_limits(1):
        labels = divide(values, analysis.frame_rate, motions, parameters.seed)
    found = len(np.unique(labels))
    if found == motions:
        return Cut(labels, keys)
    detail = (
        f"{motions} motions were asked for, but {parameters.method} distinguishes only {found}; the result has {found}."
    )
    return Cut(labels, keys, notices=(Notice(code="fewer-motions", detail=detail),))
