"""Key-frames by curve simplification (Lim and Thalmann 2001; the line of Ramer 1972, Douglas and Peucker 1973).

The curve of poses over time is first drawn as one line from its first to its last frame. The frame that strays most
from what is drawn becomes the next key-frame, until there are as many as asked for.
"""

from heapq import heappop, heappush

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.reconstruction.key_frame_motions import cut_by_key_frames
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 50_000


def curve_simplification(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take between its key-frames by curve simplification, whose poses are put into K motions."""
    return cut_by_key_frames(analysis, parameters, lambda values, count, _: simplify(values, count), MOST_FRAMES)


def simplify(values: Float[np.ndarray, "frames D"], count: int) -> Int[np.ndarray, "keys"]:
    """At most `count` key-frames in order; fewer where the lines between them meet every frame.

    O(frames · log count) where the lines are halved, O(frames · count) at worst.
    """
    keys = {0, len(values) - 1}
    waiting: list[tuple[float, int, int, int]] = []
    _push(waiting, values, 0, len(values) - 1)
    while waiting and len(keys) < count:
        _, start, farthest, stop = heappop(waiting)
        keys.add(farthest)
        _push(waiting, values, start, farthest)
        _push(waiting, values, farthest, stop)
    return np.array(sorted(keys))


def _push(
    waiting: list[tuple[float, int, int, int]], values: Float[np.ndarray, "frames D"], start: int, stop: int
) -> None:
    """Remember the frame between two key-frames that strays most from their line, the first of equal ones."""
    if stop - start < 2:
        return
    share = (np.arange(start + 1, stop) - start)[:, None] / (stop - start)
    apart = values[start + 1 : stop] - ((1 - share) * values[start] + share * values[stop])
    distance = np.einsum("fd,fd->f", apart, apart)
    farthest = int(distance.argmax())
    if distance[farthest] > 0:
        heappush(waiting, (-float(distance[farthest]), start, start + 1 + farthest, stop))
