"""Cut ends of a spline of rotations, made unit quaternions again.

Between its keys a cubic of quaternions leaves the unit sphere, and is normalised after. A key must be of unit length,
though, so an end that was cut there is put back onto the sphere, and what lies between it and the next key is traced
by as many keys as it takes, each with the derivative of the normalised curve.
"""

import numpy as np
from jaxtyping import Float

OFF_UNIT = 1e-3
"""Length that a cut end may miss 1 by and stay as it is: then the cut is exact."""

CLOSE = 1e-6
"""What a component of the traced curve may be off by."""

MOST_PIECES = 64

Rows = Float[np.ndarray, "_ 3 4"]
Times = Float[np.ndarray, "_"]


def normalise_spline_ends(times: Times, rows: Rows) -> tuple[Times, Rows]:
    """The same curve, its first and last key of unit length."""
    off = np.abs(np.linalg.norm(rows[[0, -1], 1], axis=1) - 1) > OFF_UNIT
    if len(times) == 2:
        return _resample(times, rows) if off.any() else (times, rows)
    if off[1]:
        tail_times, tail = _resample(times[-2:], rows[-2:])
        tail[0, 0] = rows[-2, 0]
        times, rows = np.concatenate([times[:-2], tail_times]), np.concatenate([rows[:-2], tail])
    if off[0]:
        head_times, head = _resample(times[:2], rows[:2])
        head[-1, 2] = rows[1, 2]
        times, rows = np.concatenate([head_times, times[2:]]), np.concatenate([head, rows[2:]])
    return times, rows


def _resample(times: Times, rows: Rows) -> tuple[Times, Rows]:
    """Two keys become several, on the unit sphere, such that the curve through them is near enough."""
    pieces = 1
    while True:
        share = np.linspace(0, 1, pieces + 1)
        seconds = times[0] + share * (times[1] - times[0])
        value, slope = _normalise_rows(*_hermite(times, rows, share))
        traced = np.stack([slope, value, slope], axis=1)
        if pieces >= MOST_PIECES or _distance(times, rows, seconds, traced) <= CLOSE:
            return seconds, traced
        pieces *= 2


def _distance(times: Times, rows: Rows, seconds: Times, traced: Rows) -> float:
    """How far the traced curve is from the one meant, in the middle of each piece and beside it."""
    worst = 0.0
    for place in (0.25, 0.5, 0.75):
        between = seconds[:-1] + place * np.diff(seconds)
        meant, _ = _normalise_rows(*_hermite(times, rows, (between - times[0]) / (times[1] - times[0])))
        pairs = [
            _normalise_rows(*_hermite(seconds[i : i + 2], traced[i : i + 2], np.array([place])))[0]
            for i in range(len(between))
        ]
        worst = max(worst, float(np.abs(np.concatenate(pairs) - meant).max()))
    return worst


def _hermite(
    times: Times, rows: Rows, s: Float[np.ndarray, "some"]
) -> tuple[Float[np.ndarray, "some 4"], Float[np.ndarray, "some 4"]]:
    """Values and derivatives by the second between two keys, at shares `s` of the way."""
    s = s[:, None]
    step = times[1] - times[0]
    a, m, b, n = rows[0, 1], rows[0, 2] * step, rows[1, 1], rows[1, 0] * step
    value = (2 * s**3 - 3 * s**2 + 1) * a + (s**3 - 2 * s**2 + s) * m + (3 * s**2 - 2 * s**3) * b + (s**3 - s**2) * n
    slope = ((6 * s**2 - 6 * s) * (a - b) + (3 * s**2 - 4 * s + 1) * m + (3 * s**2 - 2 * s) * n) / step
    return value, slope


def _normalise_rows(
    value: Float[np.ndarray, "some 4"], slope: Float[np.ndarray, "some 4"]
) -> tuple[Float[np.ndarray, "some 4"], Float[np.ndarray, "some 4"]]:
    """q / |q| and its derivative, which is across q."""
    length = np.maximum(np.linalg.norm(value, axis=1, keepdims=True), 1e-12)
    unit = value / length
    return unit, (slope - unit * np.sum(unit * slope, axis=1, keepdims=True)) / length
