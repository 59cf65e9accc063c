"""Segmentation of a take of which only features are known: joint angles, an embedding, any measurements."""

import numpy as np
from jaxtyping import Real

from caesura.core.analysis import Analysis, Features
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.core.segmentation import Segmentation
from caesura.core.segmentation_document import Source

NEEDS_VERTICES = frozenset({"joint-entropy"})
"""Methods of the energy curve, which is of a surface; there is none without vertices."""


def segment_feature_sequence(
    values: Real[np.ndarray, "frames D"], parameters: Parameters, *, frame_rate: float
) -> Segmentation:
    """The motions of a sequence of features, as `switching` and the compared methods see them; no energy curve.

    Columns are taken as they are: scale them first where their units differ. Raises `InvalidModel` (`no-motion`
    below two frames, `non-finite-data` naming the frame) or `ParameterError` (a method of the energy curve).
    """
    if parameters.method in NEEDS_VERTICES:
        raise ParameterError(
            "invalid-parameter",
            f"The method {parameters.method} cuts at the energy curve of a surface: give vertices (frames, V, 3), or"
            " choose method=switching.",
            parameter="method",
        )
    if not (np.isfinite(frame_rate) and frame_rate > 0):
        raise ParameterError("invalid-frame-rate", f"The frame rate is {frame_rate:g}; frames per second are expected.")
    frames = len(values)
    if frames < 2:
        raise InvalidModel("no-motion", "The sequence has a single frame: nothing moves.")
    finite = np.isfinite(values).all(axis=1)
    if not finite.all():
        raise InvalidModel("non-finite-data", "A feature is not a finite number.", frame=int(np.argmin(finite)))
    return cut(_analysis_of_features(values, parameters, frame_rate), parameters)


def _analysis_of_features(values: Real[np.ndarray, "frames D"], parameters: Parameters, frame_rate: float) -> Analysis:
    """What would be known of a take with these features and no surface."""
    centred = values - values.mean(axis=0, dtype=np.float64)
    largest = float(np.abs(centred).max(initial=0.0))
    unit = (centred / largest if largest else centred).astype(np.float32)  # the methods look at ratios of distances
    return Analysis(
        frames=len(values),
        frame_rate=float(frame_rate),
        source=Source(take=0, name="features", fps=float(frame_rate)),
        heavy=parameters.heavy(),
        energy=np.full(len(values), np.nan),
        peaks=np.zeros(0, np.int64),
        peak_strain=np.zeros((0, 0), np.float32),
        features=(Features("features", unit if largest else unit[:, :0], 1.0),),
        strain_scale=1.0,
    )
