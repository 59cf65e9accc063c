"""What the method saw on its way, where it is asked for: the variances of Eq. 5 and the mean strains of Eq. 4."""

import numpy as np
from jaxtyping import Int

from caesura.core.analysis import Analysis
from caesura.core.methods.joint_entropy.boundaries import variance_curve
from caesura.core.segmentation_document import KeyFrameCluster, VarianceCurve

MOST_TRIANGLES = 20_000
"""Of a finer mesh the mean strain of each triangle is left out: it would be megabytes of JSON."""


def variances_between(
    analysis: Analysis, keys: Int[np.ndarray, "keys"], clusters: Int[np.ndarray, "keys"]
) -> tuple[VarianceCurve, ...]:
    """The curve of Eq. 5 between every two neighbours of different motions that have frames between them."""
    pairs = [(int(keys[i]), int(keys[i + 1])) for i in np.flatnonzero(np.diff(clusters))]
    curves = ((left, variance_curve(analysis.energy, left, right)) for left, right in pairs if right - left > 1)
    return tuple(
        VarianceCurve(
            start=left + 1,
            boundary=left + 1 + int(np.argmin(curve)),
            values=tuple(round(value, 6) for value in curve.tolist()),
        )
        for left, curve in curves
    )


def mean_strains(
    analysis: Analysis, keys: Int[np.ndarray, "keys"], clusters: Int[np.ndarray, "keys"]
) -> tuple[KeyFrameCluster, ...]:
    """f̄ of Eq. 4 for every group of key-frames, in the order in which they appear."""
    strain = analysis.peak_strain[np.searchsorted(analysis.peaks, keys)]
    triangles, found = analysis.peak_triangles, []
    for label in dict.fromkeys(clusters.tolist()):
        mean = strain[clusters == label].mean(axis=0, dtype=np.float64)
        each = np.zeros(0)
        if 0 < len(triangles) <= MOST_TRIANGLES:
            each = np.zeros(int(triangles.max()) + 1)
            each[triangles] = mean
        found.append(
            KeyFrameCluster(
                key_frames=tuple(keys[clusters == label].tolist()),
                mean_strain=round(float(mean.mean()), 6) if mean.size else 0.0,
                strain=tuple(round(value, 4) for value in each.tolist()),
            )
        )
    return tuple(found)
