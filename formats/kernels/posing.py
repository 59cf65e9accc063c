"""The compiled loops of posing: matrices of nodes and bones, then vertices. The callers say what the arrays mean."""

import numpy as np
from numba import njit

from caesura.formats.kernels.keyframe_sampling import Doubles, Flags, Indices, Singles, compiled

FLOAT32_MAX = 3.4028234663852886e38

exact = njit(nogil=True, cache=True, fastmath={"contract", "nsz", "arcp", "afn"}, error_model="numpy")
"""Without leave to reorder sums: a frame has the same bits whichever frames it is drawn with."""

TILE = 32
"""Vertices whose sums are held at a time."""


@compiled
def _product(a: Doubles, b: Doubles, out: Doubles) -> None:
    """a · b of affine matrices, row by row 3 x 4; `out` is neither."""
    for r in range(3):
        for c in range(4):
            out[4 * r + c] = a[4 * r] * b[c] + a[4 * r + 1] * b[4 + c] + a[4 * r + 2] * b[8 + c]
        out[4 * r + 3] += a[4 * r + 3]


@compiled
def compute_world_matrices(pose: Doubles, parent: Indices, matrix: Doubles, has_matrix: Flags, out: Doubles) -> None:
    """World matrices (frames, N, 12) of nodes whose parents come before them, from poses (frames, 10 N, …)."""
    local = np.empty(12)
    for f in range(len(pose)):
        for n in range(len(parent)):
            if has_matrix[n]:
                local[:] = matrix[n]
            else:
                _matrix(pose[f], 10 * n, local)
            if parent[n] < 0:
                out[f, n] = local
            else:
                _product(out[f, parent[n]], local, out[f, n])


@compiled
def _matrix(pose: Doubles, at: int, out: Doubles) -> None:
    """Translation · rotation · scale as one affine matrix."""
    x, y, z, w = pose[at + 3], pose[at + 4], pose[at + 5], pose[at + 6]
    a, b, c = pose[at + 7], pose[at + 8], pose[at + 9]
    out[0], out[1], out[2] = (1 - 2 * (y * y + z * z)) * a, 2 * (x * y - z * w) * b, 2 * (x * z + y * w) * c
    out[4], out[5], out[6] = 2 * (x * y + z * w) * a, (1 - 2 * (x * x + z * z)) * b, 2 * (y * z - x * w) * c
    out[8], out[9], out[10] = 2 * (x * z - y * w) * a, 2 * (y * z + x * w) * b, (1 - 2 * (x * x + y * y)) * c
    out[3], out[7], out[11] = pose[at], pose[at + 1], pose[at + 2]


@compiled
def compute_bone_matrices(world: Doubles, joints: Indices, bind: Doubles, out: Doubles) -> None:
    """world[joint] · bind of every joint, the frames innermost: out (J, 12, frames)."""
    product = np.empty(12)
    for j in range(len(joints)):
        for f in range(len(world)):
            _product(world[f, joints[j]], bind[j], product)
            for i in range(12):
                out[j, i, f] = product[i]


@exact
def skin_vertices(
    positions: Singles, first: Indices, joints: Indices, weights: Doubles, matrices: Doubles, start: int, out: Singles
) -> bool:
    """Σ weight · matrix[joint] · position of vertices start …, in every frame of out (frames, V, 3); whether finite.

    Vertex v of `positions` is moved by the joints first[v] … first[v + 1] - 1. Vertices go in tiles whose sums, with
    the frames innermost, stay in the fastest memory and become vector instructions.
    """
    frames, finite = len(out), True
    sums = np.empty((3 * TILE, frames))
    for tile in range(0, len(positions), TILE):
        count = min(TILE, len(positions) - tile)
        sums[:] = 0.0
        for v in range(count):
            x, y, z = float(positions[tile + v, 0]), float(positions[tile + v, 1]), float(positions[tile + v, 2])
            for k in range(first[tile + v], first[tile + v + 1]):
                w, m = weights[k], matrices[joints[k]]
                for r in range(3):
                    for f in range(frames):
                        place = m[4 * r, f] * x + m[4 * r + 1, f] * y + m[4 * r + 2, f] * z + m[4 * r + 3, f]
                        sums[3 * v + r, f] += w * place
        finite = _store(sums, count, start + tile, out) and finite
    return finite


@exact
def skin_morphed_vertices(
    positions: Singles,
    targets: Singles,
    shares: Doubles,
    first: Indices,
    joints: Indices,
    weights: Doubles,
    matrices: Doubles,
    start: int,
    out: Singles,
) -> bool:
    """As `skin`, of positions + Σ share · target: targets (targets, V 3), shares (targets, frames)."""
    frames, finite = len(out), True
    sums, places = np.empty((3 * TILE, frames)), np.empty((3, frames))
    for tile in range(0, len(positions), TILE):
        count = min(TILE, len(positions) - tile)
        sums[:] = 0.0
        for v in range(count):
            _displaced(positions[tile + v], targets, shares, 3 * (tile + v), places)
            for k in range(first[tile + v], first[tile + v + 1]):
                w, m = weights[k], matrices[joints[k]]
                for r in range(3):
                    for f in range(frames):
                        x, y, z = places[0, f], places[1, f], places[2, f]
                        place = m[4 * r, f] * x + m[4 * r + 1, f] * y + m[4 * r + 2, f] * z + m[4 * r + 3, f]
                        sums[3 * v + r, f] += w * place
        finite = _store(sums, count, start + tile, out) and finite
    return finite


@exact
def _displaced(position: Singles, targets: Singles, shares: Doubles, at: int, out: Doubles) -> None:
    """Where one vertex is in every frame, (3, frames), before the skin moves it."""
    for r in range(3):
        out[r, :] = position[r]
        for t in range(len(targets)):
            shift = float(targets[t, at + r])
            if shift != 0:
                for f in range(shares.shape[1]):
                    out[r, f] += shares[t, f] * shift


@exact
def _store(sums: Doubles, count: int, start: int, out: Singles) -> bool:
    """Write a tile of sums, the frames innermost, into frames; whether float32 can hold them."""
    finite = True
    for f in range(len(out)):
        for v in range(count):
            for r in range(3):
                place = sums[3 * v + r, f]
                finite = finite and abs(place) <= FLOAT32_MAX
                out[f, start + v, r] = place
    return finite
