"""The neutral pose: where a performer begins and ends each repetition, and comes nearest to rest."""

import numpy as np
from jaxtyping import Float

from caesura.core.analysis import Features
from caesura.core.methods.switching.window_statistics import compute_speeds

FARNESS, HASTE = 2.0, 2.0
"""What it costs, for each frame of the period, to end a repetition as far from the neutral pose as two poses at random,
or at the mean square speed."""
CALMEST = 5.0
"""Percent of the frames that are the nearest and the slowest: they cost nothing."""
EDGE_SHARE = 0.1
"""Of the period: so much is left out at either end of the segment, and so much tells the neutral pose."""
SMOOTH_SECONDS = 0.1
MOVING = 0.2
"""Of the mean square speed: who is nowhere slower does not rest, and repetitions may end anywhere, as a walk's do."""


def end_prices(
    features: tuple[Features, ...], start: int, end: int, frame_rate: float, period: int
) -> Float[np.ndarray, "frames"]:
    """What it costs to end a repetition at each frame of [start, end), for each frame of the period."""
    poses, speed = _poses_and_speed(features, start, end, frame_rate)
    reach = max(round(SMOOTH_SECONDS * frame_rate), 1)
    speed = np.convolve(np.pad(speed, reach, "edge"), np.full(2 * reach + 1, 1 / (2 * reach + 1)), "valid")
    edge = min(max(round(EDGE_SHARE * period), 1), len(poses) // 4)
    far = np.zeros(len(poses))
    rests = max(1 - float(np.percentile(speed, CALMEST)) / MOVING, 0.0)
    for part in (slice(edge, 2 * edge), slice(len(poses) - 2 * edge, len(poses) - edge)):
        apart = poses - poses[part].mean(axis=0)
        far += np.einsum("fd,fd->f", apart, apart) / 4 / len(features)  # two poses at random: 2 for each descriptor
    return np.asarray(rests * (FARNESS * _above_calmest(far) + HASTE * _above_calmest(speed)))


def _poses_and_speed(
    features: tuple[Features, ...], start: int, end: int, frame_rate: float
) -> tuple[Float[np.ndarray, "frames D"], Float[np.ndarray, "frames"]]:
    """Every descriptor at unit mean square there, and the mean of their squared speeds, each at unit mean."""
    poses: list[np.ndarray] = []
    squares: list[np.ndarray] = []
    for feature in features:
        values = feature.values[start:end].astype(np.float64)
        values -= values.mean(axis=0)
        rates = compute_speeds(values, frame_rate)
        for part, found in ((values, poses), (rates, squares)):
            mean = float(np.einsum("fd,fd->", part, part)) / len(part)
            if mean > 0:
                found.append(part / np.sqrt(mean))
    joined = np.concatenate(squares, axis=1)
    return np.concatenate(poses, axis=1), np.einsum("fd,fd->f", joined, joined) / len(squares)


def _above_calmest(values: Float[np.ndarray, "frames"]) -> Float[np.ndarray, "frames"]:
    return np.asarray(np.maximum(values - np.percentile(values, CALMEST), 0.0))
