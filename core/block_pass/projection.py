"""Projection of a descriptor to its leading components, learnt from a sample and applied as a stream."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from threadpoolctl import threadpool_limits

COMPONENTS = 20
SAMPLE = 2000


@dataclass(frozen=True)
class Projection:
    """Principal components of a descriptor of length D.

    `mean` (D,), `components` (D, C) orthonormal columns ordered by variance, C ≤ 20 (0 where nothing varies);
    `energy_share`, 0 to 1, is the share of the sample's variance they keep (1 where nothing varies).
    """

    mean: Float[np.ndarray, "D"]
    components: Float[np.ndarray, "D C"]
    energy_share: float

    @classmethod
    def of(cls, sample: Float[np.ndarray, "sample D"], components: int = COMPONENTS) -> "Projection":
        """The components of some frames of the descriptor, by the eigenvectors of the smaller Gram matrix.

        One BLAS thread and a fixed sign (the largest entry of each column is positive) make them the same for
        any number of threads. Directions that vary by less than rounding are left out.
        """
        mean = sample.mean(axis=0, dtype=np.float64)
        centred = sample - mean
        with threadpool_limits(1):
            variance, directions = _principal_components(centred, components)
        total = float(np.einsum("sd,sd->", centred, centred))
        largest = np.abs(directions).argmax(axis=0) if directions.size else np.zeros(0, np.int64)
        signs = np.where(directions[largest, np.arange(directions.shape[1])] < 0, -1.0, 1.0)
        share = min(float(variance.sum()) / total, 1.0) if total > 0 else 1.0
        return cls(mean.astype(np.float32), (directions * signs).astype(np.float32), share)

    def project(self, block: Float[np.ndarray, "frames D"]) -> Float[np.ndarray, "frames C"]:
        """The centred frames in these components, float32, not rescaled: distances stay the descriptor's.

        Safe from several threads; the caller holds BLAS to one thread, as everywhere in the core.
        """
        return np.asarray((block - self.mean) @ self.components, np.float32)


def choose_sample_frames(frames: int, most: int = SAMPLE) -> Int[np.ndarray, "sample"]:
    """At most `most` frames, evenly spaced from the first to the last: what the projection is learnt from."""
    if frames <= most:
        return np.arange(frames)
    return np.linspace(0, frames - 1, most).round().astype(np.int64)


def _principal_components(
    centred: Float[np.ndarray, "sample D"], components: int
) -> tuple[Float[np.ndarray, "C"], Float[np.ndarray, "D C"]]:
    """Leading eigenvalues of the scatter matrix and their unit eigenvectors, largest first."""
    tall = centred.shape[0] >= centred.shape[1]
    values, vectors = np.linalg.eigh(centred.T @ centred if tall else centred @ centred.T)
    values, vectors = values[::-1][:components], vectors[:, ::-1][:, :components]
    # Below this an eigenvalue is the rounding of float32 input, and its direction arbitrary.
    real = values > max(values[0] * 1e-10, 0.0) if len(values) else np.zeros(0, bool)
    values, vectors = values[real], vectors[:, real]
    return values, vectors if tall else centred.T @ vectors / np.sqrt(values)
