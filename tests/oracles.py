"""Slow, obvious twins of what the core computes, in float64 and plain loops."""

from collections import Counter
from itertools import pairwise

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


# --- windows and switching k-means ---


def windows(values, half, frame_rate):
    """Mean, standard deviation and RMS speed of each window, window by window."""
    speed = np.zeros_like(values) if len(values) < 2 else np.gradient(values, axis=0) * frame_rate
    cut = [slice(max(i - half, 0), i + half + 1) for i in range(len(values))]
    mean = np.array([values[w].mean(axis=0) for w in cut])
    deviation = np.array([values[w].std(axis=0) for w in cut])
    return mean, deviation, np.array([np.sqrt((speed[w] ** 2).mean(axis=0)) for w in cut])


def cheapest_labels(cost, penalty):
    """The least Σ cost[t, label] + penalty · changes over every possible labelling, and a labelling that has it."""
    steps, states = cost.shape
    best = (np.inf, None)
    for code in range(states**steps):
        labels = [code // states**t % states for t in range(steps)]
        changes = sum(a != b for a, b in pairwise(labels))
        total = sum(cost[t, k] for t, k in enumerate(labels)) + penalty * changes
        best = min(best, (total, labels), key=lambda candidate: candidate[0])
    return best


def cheapest_partition(values, penalty, longest):
    """The least Σ squared distance of pieces to their means + penalty · pieces, over every partition."""
    steps = len(values)
    best = np.inf
    for code in range(2 ** (steps - 1)):
        bounds = [0, *(t + 1 for t in range(steps - 1) if code >> t & 1), steps]
        pieces = [values[a:b] for a, b in pairwise(bounds)]
        if max(map(len, pieces)) <= longest:
            best = min(best, sum(((p - p.mean(axis=0)) ** 2).sum() + penalty for p in pieces))
    return best


def ward(means, weights):
    """Ward's merges by looking at every pair each time: (first, second) in order."""
    groups = {i: (np.array(m, float), float(w)) for i, (m, w) in enumerate(zip(means, weights, strict=True))}
    merges = []
    while len(groups) > 1:
        pairs = [(i, j) for i in groups for j in groups if i < j]
        price = {
            (i, j): ((groups[i][0] - groups[j][0]) ** 2).sum() * groups[i][1] * groups[j][1]
            / (groups[i][1] + groups[j][1])
            for i, j in pairs
        }  # fmt: skip
        i, j = min(pairs, key=price.get)
        (mean_i, weight_i), (mean_j, weight_j) = groups[i], groups.pop(j)
        groups[i] = ((mean_i * weight_i + mean_j * weight_j) / (weight_i + weight_j), weight_i + weight_j)
        merges.append((i, j))
    return merges


# --- compared methods: alignment and dissimilarity ---


def alignments(rows, columns):
    """Every path from (0, 0) to the last corner, as lists of cells."""
    if rows == columns == 1:
        return [[(0, 0)]]
    before = []
    for r, c in ((rows - 1, columns), (rows, columns - 1), (rows - 1, columns - 1)):
        before += alignments(r, c) if r and c else []
    return [[*path, (rows - 1, columns - 1)] for path in before]


def dtak(kernel, own, other):
    """The dynamic time alignment kernel of two weighted segments by trying every path: the dearest one's value.

    A step pays the kernel at the cell it reaches times the weights of those samples that it takes anew.
    """
    best = -np.inf
    for path in alignments(len(own), len(other)):
        value = (own[0] + other[0]) * kernel[0, 0]
        for (i, j), (r, c) in pairwise(path):
            value += ((r > i) * own[r] + (c > j) * other[c]) * kernel[r, c]
        best = max(best, value)
    return best / (sum(own) + sum(other))


def compositions(total, shortest, longest):
    """Every way to cut `total` samples into segments of these lengths, as bounds."""
    if total == 0:
        return [[0]]
    lengths = range(shortest, min(longest, total) + 1)
    return [[*head, total] for n in lengths for head in compositions(total - n, shortest, longest)]


def least_recut(kernel, weights, bounds, labels, longest):
    """The least cost of any segmentation whose segments join the nearest mean of the given groups of segments."""
    given = list(pairwise(bounds))
    members = {c: [s for s, label in zip(given, labels, strict=True) if label == c] for c in sorted(set(labels))}

    def alike(one, other):
        (a, b), (c, d) = one, other
        return dtak(kernel[a:b, c:d], weights[a:b], weights[c:d])

    spread = {c: np.mean([alike(s, t) for s in of_group for t in of_group]) for c, of_group in members.items()}

    def cost(segment):
        a, b = segment
        own = (weights[a:b] * np.diag(kernel)[a:b]).sum() / weights[a:b].sum()
        return min(own - 2 * np.mean([alike(segment, s) for s in members[c]]) + spread[c] for c in members)

    costs = {(a, b): cost((a, b)) for b in range(1, len(kernel) + 1) for a in range(max(b - longest, 0), b)}
    return min(sum(costs[s] for s in pairwise(cut)) for cut in compositions(len(kernel), 1, longest))


def persistent(kernel, longest):
    """The propagated likeness, pair by pair and lag by lag."""
    samples = len(kernel)
    out = np.zeros_like(kernel)
    for i in range(samples):
        for j in range(i + 1, samples):
            for w in range(1, longest + 1):
                if j + w < samples:
                    least = min(kernel[i, j], kernel[i + w, j + w])
                    for a, b in ((i, j), (i + w, j + w), (i, j + w), (i + w, j)):
                        out[a, b] = max(out[a, b], least)
    upper = np.triu(out, 1)
    return upper + upper.T + np.eye(samples)


def fewest_strangers(labels, shortest, longest):
    """The least number of samples that are not of their segment's most frequent label, over every segmentation."""
    return min(
        sum(b - a - np.bincount(labels[a:b]).max() for a, b in pairwise(cut))
        for cut in compositions(len(labels), shortest, longest)
    )


def dissimilarity(values, bounds):
    """Σ over segments of the average distance of all pairs of frames within one."""
    total = 0.0
    for a, b in pairwise(bounds):
        pairs = [np.linalg.norm(values[i] - values[j]) for i in range(a, b) for j in range(i + 1, b)]
        total += np.mean(pairs) if pairs else 0.0
    return total


def least_dissimilarity(values, segments, shortest):
    """The least of it over every segmentation into so many segments."""
    cuts = compositions(len(values), shortest, len(values))
    return min(dissimilarity(values, cut) for cut in cuts if len(cut) == segments + 1)


# --- curvature, geodesic distance, heat kernel signature ---


def curvature(vertices, rest, triangles, kind="gaussian"):
    """|Δ Σ K A| (frames, T), or |Δ Σ H A| over √A₀, summed over the corners; closed or open, wound one way."""
    vertices, rest = np.asarray(vertices, np.float64), np.asarray(rest, np.float64)
    cell = np.zeros(len(rest))
    for face in triangles:
        a, b, c = rest[face]
        cell[face] += np.linalg.norm(np.cross(b - a, c - a)) / 6
    measure = _angle_defects if kind == "gaussian" else _folds
    at_rest = measure(rest, triangles)
    change = np.stack([np.abs((measure(v, triangles) - at_rest)[triangles].sum(axis=1)) for v in vertices])
    return change if kind == "gaussian" else change / np.sqrt(cell[triangles].sum(axis=1))


def _angle_defects(place, triangles):
    edges = Counter(frozenset(pair) for i, j, k in triangles for pair in ((i, j), (j, k), (k, i)))
    border = {v for edge, count in edges.items() if count == 1 for v in edge}
    defect = np.array([np.pi if v in border else 2 * np.pi for v in range(len(place))])
    for face in triangles:
        for turn in range(3):
            at, left, right = place[np.roll(face, turn)]
            cosine = (left - at) @ (right - at) / np.linalg.norm(left - at) / np.linalg.norm(right - at)
            defect[face[-turn % 3]] -= np.arccos(np.clip(cosine, -1, 1))
    return defect


def _folds(place, triangles):
    across = {(i, j): k for face in triangles for i, j, k in (face, np.roll(face, 1), np.roll(face, 2))}
    total = np.zeros(len(place))
    for (i, j), k in across.items():
        if i < j and (j, i) in across:
            a, b, c, d = place[[i, j, k, across[j, i]]]
            one, other = np.cross(b - a, c - a), np.cross(d - a, b - a)
            cosine = one @ other / np.linalg.norm(one) / np.linalg.norm(other)
            fold = -np.sign(one @ (d - a)) * np.arccos(np.clip(cosine, -1, 1))
            total[[i, j]] += np.linalg.norm(b - a) * fold / 4
    return total


def path_lengths(place, triangles):
    """The length of the shortest path of edges between any two points (Floyd 1962); inf where there is none."""
    place = np.asarray(place, np.float64)
    length = np.full((len(place), len(place)), np.inf)
    np.fill_diagonal(length, 0)
    for face in triangles:
        for i, j in zip(face, np.roll(face, 1), strict=True):
            length[i, j] = length[j, i] = np.linalg.norm(place[i] - place[j])
    for k in range(len(place)):
        length = np.minimum(length, length[:, k, None] + length[None, k])
    return length


def heat_kernel_signature(place, triangles, times):
    """h_t (points, times) of every eigenfunction there is."""
    place = np.asarray(place, np.float64)
    stiffness, mass = np.zeros((len(place), len(place))), np.zeros(len(place))
    for face in triangles:
        for turn in range(3):
            i, j, k = np.roll(face, turn)
            u, v = place[j] - place[i], place[k] - place[i]
            doubled = np.linalg.norm(np.cross(u, v))
            mass[i] += doubled / 6
            weight = u @ v / doubled / 2
            stiffness[[j, k], [k, j]] -= weight
            stiffness[[j, k], [j, k]] += weight
    root = np.sqrt(mass)
    values, modes = np.linalg.eigh(stiffness / np.outer(root, root))
    return (modes / root[:, None]) ** 2 @ np.exp(-np.outer(values, times))
