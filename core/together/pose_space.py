"""The pose space: poses of all takes as the same few numbers, with the habits of each take left out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

from caesura.core.methods.switching.window_statistics import compute_speeds
from caesura.core.single_threaded_blas import single_threaded_blas
from caesura.core.together.body_poses import BodyPoses, turn_onto
from caesura.core.together.compared_body import ComparedBody
from caesura.core.together.mirror_symmetry import find_mirror_symmetry

DIRECTIONS = 24
SAMPLE = 300
"""Poses of a take that the directions are learnt from."""
MIRROR_POSES = 48
"""Poses, of all takes together, in which left and right are looked for."""
SMOOTH_SECONDS = 0.1


@dataclass(frozen=True)
class PoseSpace:
    """What poses are compared in.

    `reference` (points, 3): the mean of the takes' median poses. `directions` (3 · points, d): the leading directions
    in which poses of a take leave its median, divided by how far they do. `signs` (d,): 1 or −1, a mirrored pose has
    every number times its sign; `mirrors`: whether the body has a left and a right.
    """

    body: ComparedBody
    reference: Float[np.ndarray, "points 3"]
    directions: Float[np.ndarray, "D d"]
    signs: Float[np.ndarray, "d"]
    mirrors: bool

    @classmethod
    def learn(cls, takes: Sequence[tuple[str, BodyPoses]]) -> "PoseSpace":
        """Of takes with their names; raises what `ComparedBody.of` raises."""
        body = ComparedBody.of(takes)
        with single_threaded_blas():
            places = [_sampled(body.places(poses)) for _, poses in takes]
            medians = [np.median(found, axis=0) for found in places]
            reference = medians[0].astype(np.float64)
            reference = np.mean([turn_onto(median[None], reference)[0] for median in medians], axis=0)
            turned = [_turned(found, reference) for found in places]
            step = max(sum(map(len, turned)) // MIRROR_POSES, 1)
            mirror = find_mirror_symmetry(np.concatenate(turned)[::step].astype(np.float64))
            moments = np.mean([_moment(found) for found in turned], axis=0)
            signs = np.ones(min(DIRECTIONS, len(moments)))
            if mirror is not None:
                matrix = mirror.matrix()
                moments = (moments + matrix.T @ moments @ matrix) / 2
            directions = np.linalg.eigh(moments)[1][:, ::-1][:, : len(signs)]
            if mirror is not None:
                signs = np.sign(np.einsum("dk,de,ek->k", directions, matrix, directions))
        spread = float(np.sqrt(np.trace(moments))) or 1.0
        return cls(body, reference, directions / spread, signs, mirror is not None)

    def track(self, name: str, poses: BodyPoses) -> Float32[np.ndarray, "steps d"]:
        """A take in this space, about its median pose, smoothed over a tenth of a second; `name` is for errors."""
        self.body.check(name, poses)
        places = _turned(self.body.places(poses), self.reference)
        leaving = (places - np.median(places, axis=0)).reshape(len(places), -1)
        window = max(round(SMOOTH_SECONDS * poses.rate), 1)
        return _smoothed(leaving.astype(np.float32) @ self.directions.astype(np.float32), window)

    def speeds(self, track: Float32[np.ndarray, "steps d"], rate: float) -> Float32[np.ndarray, "steps d"]:
        """How fast a take goes through this space, per second."""
        return np.asarray(compute_speeds(track, rate), np.float32)


def _sampled(places: Float32[np.ndarray, "steps points 3"]) -> Float32[np.ndarray, "sample points 3"]:
    if len(places) <= SAMPLE:
        return places
    return places[np.linspace(0, len(places) - 1, SAMPLE).round().astype(np.int64)]


def _turned(
    places: Float32[np.ndarray, "steps points 3"], reference: Float[np.ndarray, "points 3"]
) -> Float32[np.ndarray, "steps points 3"]:
    """All poses of a take turned alike, so that its median pose is nearest to the reference, and in its size."""
    median = np.median(places, axis=0).astype(np.float64)
    size = float(np.sqrt(np.einsum("pi,pi->", median, median) / len(median))) or 1.0
    left, _, right = np.linalg.svd(median.T @ reference)
    if np.linalg.det(left @ right) < 0:
        left[:, -1] *= -1
    return np.asarray(places @ ((left @ right) / size).astype(np.float32), np.float32)


def _moment(places: Float32[np.ndarray, "steps points 3"]) -> Float[np.ndarray, "D D"]:
    leaving = (places - np.median(places, axis=0)).reshape(len(places), -1).astype(np.float64)
    return np.asarray(leaving.T @ leaving / len(leaving))


def _smoothed(values: Float32[np.ndarray, "steps d"], window: int) -> Float32[np.ndarray, "steps d"]:
    """Means over `window` steps; ends are repeated."""
    if window < 2 or len(values) < 2:
        return values
    padded = np.pad(values, ((window // 2 + 1, window - 1 - window // 2), (0, 0)), "edge").astype(np.float64)
    total = np.cumsum(padded, axis=0)
    return np.asarray((total[window:] - total[:-window]) / window, np.float32)
