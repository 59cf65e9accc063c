"""The takes of the chaos run: small ones, each different, and every tenth long enough to be killed in the middle."""

import io

import numpy as np

SMALL_FRAMES, LONG_FRAMES = 240, 2400
RATE = 30.0


def takes(count: int) -> list[bytes]:
    """So many NPZ files, no two the same."""
    return [_take(number, LONG_FRAMES if number % 10 == 0 else SMALL_FRAMES) for number in range(count)]


def _take(number: int, frames: int) -> bytes:
    """A sheet that bends at one pace and then at another, its own for every take."""
    side = 12
    row, column = np.divmod(np.arange(side * side), side)
    corner = np.array([r * side + c for r in range(side - 1) for c in range(side - 1)])
    triangles = np.concatenate([corner[:, None] + [0, 1, side], corner[:, None] + [1, side + 1, side]])
    seconds = np.arange(frames)[:, None] / RATE
    pace = np.where(seconds < frames / RATE / 2, 4.0, 1.5 + number / 100)
    lift = np.sin(pace * seconds) * column**2 / side
    vertices = np.stack([np.broadcast_to(column, lift.shape), np.broadcast_to(row, lift.shape), lift], axis=2)
    out = io.BytesIO()
    np.savez(out, vertices=vertices.astype(np.float32), triangles=triangles, frame_rate=np.float64(RATE))
    return out.getvalue()
