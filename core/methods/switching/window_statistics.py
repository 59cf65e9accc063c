"""Windows: one pose says little, a second of motion says which motion it is."""

import numpy as np
from jaxtyping import Float, Int


def compute_window_statistics(
    values: Float[np.ndarray, "frames components"], half: int, frame_rate: float, at: Int[np.ndarray, "steps"]
) -> tuple[
    Float[np.ndarray, "steps components"],
    Float[np.ndarray, "steps components"],
    Float[np.ndarray, "steps components"],
]:
    """Mean, standard deviation and RMS speed of every component in the windows [i − half, i + half] for i in `at`.

    Windows are cut short at the ends of the take. Speeds are central differences, per second (0 for a single
    frame). Prefix sums: O(frames), whatever the window is.
    """
    values = values - values.mean(axis=0, dtype=np.float64)
    start, stop = np.maximum(at - half, 0), np.minimum(at + half + 1, len(values))
    mean = _window_mean(values, start, stop)
    # Below this the difference of squares is rounding, and its root would be much larger than it.
    rounding = 1e-12 * np.einsum("fc,fc->c", values, values) / len(values)
    variance = _window_mean(values * values, start, stop) - mean * mean
    deviation = np.sqrt(np.where(variance > rounding, variance, 0.0))
    speed = compute_speeds(values, frame_rate)
    return mean, deviation, np.sqrt(np.maximum(_window_mean(speed * speed, start, stop), 0.0))


def compute_speeds(
    values: Float[np.ndarray, "frames components"], frame_rate: float
) -> Float[np.ndarray, "frames components"]:
    """Central differences per second, one-sided at the ends; zero for a single frame."""
    if len(values) < 2:
        return np.zeros_like(values)
    return np.asarray(np.gradient(values, axis=0) * frame_rate)


def _window_mean(
    values: Float[np.ndarray, "frames components"], start: Int[np.ndarray, "steps"], stop: Int[np.ndarray, "steps"]
) -> Float[np.ndarray, "steps components"]:
    total = np.zeros((len(values) + 1, values.shape[1]))
    np.cumsum(values, axis=0, out=total[1:])
    return np.asarray((total[stop] - total[start]) / (stop - start)[:, None])
