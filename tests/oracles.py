"""Slow, obvious twins of what the core computes, in float64 and plain loops."""

import numpy as np

# --- strain, energy, boundaries (paper, sections 3 and 4) ---


def strain(vertices, rest, triangles, measure="log"):
    """Strain (frames, T) by the singular values of each triangle's 3x2 deformation; degenerate triangles are NaN."""
    vertices, rest = np.asarray(vertices, np.float64), np.asarray(rest, np.float64)
    out = np.full((len(vertices), len(triangles)), np.nan)
    for t, (i, j, k) in enumerate(triangles):
        e1, e2 = rest[j] - rest[i], rest[k] - rest[i]
        u = e1 / np.linalg.norm(e1)
        w = e2 - (e2 @ u) * u
        if np.linalg.norm(w) == 0:
            continue
        w /= np.linalg.norm(w)
        flat = np.array([[e1 @ u, e2 @ u], [e1 @ w, e2 @ w]])
        edges = np.stack([vertices[:, j] - vertices[:, i], vertices[:, k] - vertices[:, i]], axis=2)
        stretch = np.maximum(np.linalg.svd(edges @ np.linalg.inv(flat), compute_uv=False), 1e-3)
        if measure == "log":
            out[:, t] = np.sqrt((np.log(stretch) ** 2).sum(axis=1))
        elif measure == "biot":
            out[:, t] = np.sqrt(((stretch - 1) ** 2).sum(axis=1))
        else:
            out[:, t] = np.abs(stretch - 1).max(axis=1)
    return out


def energy(bins, levels, window):
    """H (frames,) of Eq. 3 from bins (frames, T), pair by pair; window 1 is Eq. 1 on neighbours."""
    frames, triangles = bins.shape
    curve = np.full(frames, np.nan)
    for m in range(window - 1, frames - window):
        joint = np.zeros((levels, levels))
        for n in range(m - window + 1, m + 1):
            for t in range(triangles):
                joint[bins[n, t], bins[n + window, t]] += 1
        p = joint[joint > 0] / (triangles * window)
        curve[m] = -(p * np.log(p)).sum()
    return curve


def bins(values, scale, levels):
    """φ1 = [0, 1/B], φi = ((i−1)/B, i/B], as 0 … B−1, of values over `scale`, clipped at 1."""
    return np.clip(np.ceil(np.minimum(values / scale, 1) * levels).astype(int) - 1, 0, levels - 1)


def boundary(curve, left, right):
    """The first frame between two key-frames that minimises Eq. 5, by np.var."""
    cost = {m: np.var(curve[left : m + 1]) + np.var(curve[m : right + 1]) for m in range(left + 1, right)}
    return min(cost, key=cost.get) if cost else right


def algorithm_1_as_printed(curve, window):
    """The paper's Algorithm 1, word for word (0-based): what its erratum is about."""
    keys = []
    for i in range(len(curve) - window):
        loc = i + int(np.argmax(curve[i : i + window + 1]))
        if not keys or not i <= keys[-1] <= i + window:
            keys.append(loc)
        elif keys[-1] != loc:
            keys[-1] = loc
    return keys
