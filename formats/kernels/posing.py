"""The compiled loops of posing: matrices of nodes and bones, then vertices. The callers say what the arrays mean."""

import numpy as np
from numba import njit

from caesura.core.kernels.descriptors import WIDTH
from caesura.formats.kernels.keyframe_sampling import Doubles, Flags, Indices, Singles, compiled

FLOAT32_MAX = 3.4028234663852886e38

exact = njit(nogil=True, cache=True, fastmath={"contract", "nsz", "arcp", "afn"}, error_model="numpy")
"""Without leave to reorder sums: a frame has the same bits whichever frames it is drawn with."""

inlined = njit(
    nogil=True, cache=True, fastmath={"contract", "nsz", "arcp", "afn"}, error_model="numpy", inline="always"
)


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


@compiled
def centre_matrices(matrices: Doubles, centres: Singles, anchor: int, at: int, out: Singles, origin: Singles) -> None:
    """Matrices (B, 12, frames) as float32 in columns `at` … of `out` (B, 12 · WIDTH), for positions from `centres`.

    They lead to places from `origin` (3, WIDTH), where the centre of bone `anchor` is: numbers as small as the body,
    wherever it was modelled and wherever it is, so that float32 keeps their digits.
    """
    frames = matrices.shape[2]
    for r in range(3):
        for f in range(frames):
            origin[r, at + f] = _place(matrices[anchor], centres[anchor], r, f)
    for b in range(len(matrices)):
        for r in range(3):
            for f in range(frames):
                for c in range(3):
                    out[b, (4 * r + c) * WIDTH + at + f] = matrices[b, 4 * r + c, f]
                place = _place(matrices[b], centres[b], r, f)
                out[b, (4 * r + 3) * WIDTH + at + f] = place - float(origin[r, at + f])


@compiled
def _place(matrix: Doubles, position: Singles, r: int, f: int) -> float:
    """Coordinate `r` of matrix · position in frame `f`."""
    turned = matrix[4 * r, f] * position[0] + matrix[4 * r + 1, f] * position[1] + matrix[4 * r + 2, f] * position[2]
    return float(turned + matrix[4 * r + 3, f])


@exact
def skin_vertices(
    start: int,
    stop: int,
    positions: Singles,
    first: Indices,
    joints: Indices,
    weights: Singles,
    centres: Singles,
    matrices: Singles,
    origin: Singles,
    rows: Singles,
    frames: tuple[int, int],
) -> None:
    """Σ weight · matrix[joint] · position of vertices [start, stop) in these `frames` of rows (stop − start, 3, F).

    Vertex v is moved by the joints first[v] … first[v + 1] - 1. `matrices` and `origin` are those of
    `centre_matrices`, each matrix in one piece, so that the compiler sees that its rows are apart: the innermost loops
    go over frames and become vector instructions.
    """
    for v in range(start, stop):
        for r in range(3):
            rows[v - start, r][frames[0] : frames[1]] = np.float32(0)
        for k in range(first[v], first[v + 1]):
            w, m, centre = weights[k], matrices[joints[k]], centres[joints[k]]
            x, y, z = positions[v, 0] - centre[0], positions[v, 1] - centre[1], positions[v, 2] - centre[2]
            x, y, z = w * x, w * y, w * z
            for r in range(3):
                _add_bone(m, 4 * r * WIDTH, x, y, z, w, rows[v - start, r][frames[0] : frames[1]])
        for r in range(3):
            _add(origin[r], rows[v - start, r][frames[0] : frames[1]])


@inlined
def _add_bone(m: Singles, row: int, x: np.float32, y: np.float32, z: np.float32, w: np.float32, sums: Singles) -> None:
    """sums[f] += row of a matrix · (x, y, z, w)."""
    for f in range(sums.size):
        i = row + f
        sums[f] += m[i] * x + m[i + WIDTH] * y + m[i + 2 * WIDTH] * z + m[i + 3 * WIDTH] * w


@inlined
def _add(values: Singles, sums: Singles) -> None:
    for f in range(sums.size):
        sums[f] += values[f]


@exact
def skin_morphed_vertices(
    start: int,
    stop: int,
    positions: Singles,
    first: Indices,
    joints: Indices,
    weights: Singles,
    centres: Singles,
    matrices: Singles,
    origin: Singles,
    rows: Singles,
    frames: tuple[int, int],
    targets: Singles,
    shares: Singles,
    first_target: int,
) -> None:
    """As `skin_vertices`, of positions + Σ share · target: shares (targets, WIDTH), targets (targets, 3 · vertices).

    The first of the targets' vertices is `first_target`.
    """
    shifts = np.empty((3, frames[1] - frames[0]), np.float32)
    for v in range(start, stop):
        for r in range(3):
            rows[v - start, r][frames[0] : frames[1]] = np.float32(0)
        _displace(targets, shares, 3 * (v - first_target), shifts)
        for k in range(first[v], first[v + 1]):
            w, m, centre = weights[k], matrices[joints[k]], centres[joints[k]]
            x, y, z = positions[v, 0] - centre[0], positions[v, 1] - centre[1], positions[v, 2] - centre[2]
            for r in range(3):
                sums = rows[v - start, r][frames[0] : frames[1]]
                _add_shifted(m, 4 * r * WIDTH, x, y, z, w, shifts, sums)
        for r in range(3):
            _add(origin[r], rows[v - start, r][frames[0] : frames[1]])


@inlined
def _add_shifted(
    m: Singles,
    row: int,
    x: np.float32,
    y: np.float32,
    z: np.float32,
    w: np.float32,
    shifts: Singles,
    sums: Singles,
) -> None:
    """sums[f] += w · row of a matrix · the place (x, y, z, 1) shifted."""
    for f in range(sums.size):
        i = row + f
        place = m[i] * (x + shifts[0, f]) + m[i + WIDTH] * (y + shifts[1, f]) + m[i + 2 * WIDTH] * (z + shifts[2, f])
        sums[f] += w * (place + m[i + 3 * WIDTH])


@exact
def _displace(targets: Singles, shares: Singles, at: int, shifts: Singles) -> None:
    """Σ share · target of one vertex in every frame, (3, frames)."""
    for r in range(3):
        shifts[r] = np.float32(0)
        for t in range(len(targets)):
            shift = targets[t, at + r]
            if shift != 0:
                for f in range(shifts.shape[1]):
                    shifts[r, f] += shares[t, f] * shift


@exact
def store_frames(rows: Singles, count: int, start: int, out: Singles) -> bool:
    """out[f, start + v] = the place of vertex v of `count` in rows (vertices, 3, F); whether all are finite."""
    finite = True
    for f in range(len(out)):
        for v in range(count):
            for r in range(3):
                place = rows[v, r, f]
                finite = finite and abs(place) <= FLOAT32_MAX
                out[f, start + v, r] = place
    return finite
