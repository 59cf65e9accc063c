"""Key-frames: the moments where the energy curve is highest (paper, section 3.3).

Erratum. Algorithm 1 as printed looks at the window that begins at i, and once the last key-frame has left that
window it appends the window's maximum: on a falling stretch of the curve this is its first frame, again and again.
What the text asks for is done here: local maxima that are also the maximum of the ω frames centred on them.
"""

import numpy as np
from jaxtyping import Float, Int


def find_local_maxima(energy: Float[np.ndarray, "frames"]) -> Int[np.ndarray, "peaks"]:
    """Every frame that rises above its neighbours; of equal neighbours the first. NaN is lower than anything.

    A curve that never changes has no maximum: nothing happens in it. An end of the curve can be one.
    """
    height = np.where(np.isnan(energy), -np.inf, energy)
    if len(height) == 0 or height.max() == height[np.isfinite(height)].min(initial=np.inf):
        return np.zeros(0, np.int64)
    starts = np.flatnonzero(np.concatenate([[True], height[1:] != height[:-1]]))  # of runs of equal values
    level = height[starts]
    rises = np.concatenate([[True], level[1:] > level[:-1]])
    falls = np.concatenate([level[:-1] > level[1:], [True]])
    return np.asarray(starts[rises & falls & np.isfinite(level)])


def extract_key_frames(
    energy: Float[np.ndarray, "frames"], peaks: Int[np.ndarray, "peaks"], window: int, threshold: float
) -> Int[np.ndarray, "keys"]:
    """The peaks that are the highest of the `window` (ω) frames centred on them, and not below `threshold` · max H.

    Of equal peaks within half a window the first counts. `window` in frames, `threshold` a share, 0 to 1.
    """
    if len(peaks) == 0:
        return peaks
    height = np.where(np.isnan(energy), -np.inf, energy)
    half = max(window // 2, 1)
    chosen: list[int] = []
    for peak in peaks[height[peaks] >= threshold * height.max()].tolist():
        if height[peak] < height[max(peak - half, 0) : peak + half + 1].max():
            continue
        if not chosen or peak - chosen[-1] > half or height[peak] != height[chosen[-1]]:
            chosen.append(peak)
    return np.array(chosen, np.int64)
