"""The size of the whole body, taken out of every frame before anything is measured (`scale_invariant`; section 3).

Once for all descriptors: a body that only grows and shrinks is then at rest for each of them.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, Float64, Int, Int32

from caesura.core.animation import Animation, Vertices
from caesura.core.frames.vertex_rows import gather_rows
from caesura.core.kernels import descriptors
from caesura.core.mesh.farthest_points import sample_farthest_points

POINTS = 150
LARGEST_FACTOR = 1e6
"""What is squeezed to less than a millionth of its size stays smaller: it has no shape left that could be seen."""


@dataclass(frozen=True)
class VerticesAtRestSize:
    """Draws the frames of `source`, each scaled about the origin until the body is as large as it is at rest.

    The size of a surface is the root of its area. That of a skeleton is the length of the tree of shortest lines that
    joins its joints at rest (`corners` of two), which are its bones or nearly so: bending changes neither much.
    """

    source: Vertices
    members: Int32[np.ndarray, "n"]
    corners: Int32[np.ndarray, "parts ends"]
    at_rest: float

    def __call__(self, start: int, stop: int) -> Float32[np.ndarray, "block V 3"]:
        """Frames [start, stop), float32. A frame that has no size, or that holds what is no number, stays as it is."""
        block = np.ascontiguousarray(self.source(start, stop), np.float32)
        sizes = _sizes(block, self.members, self.corners)
        with np.errstate(divide="ignore"):
            factors = np.minimum(self.at_rest / sizes, LARGEST_FACTOR)
        factors[~(np.isfinite(sizes) & (sizes > 0))] = 1.0
        return np.asarray(block * factors[:, None, None], np.float32)


def scale_to_rest_size(animation: Animation, rest: Float32[np.ndarray, "V 3"]) -> Animation:
    """The same animation with the body as large in every frame as it is at rest; itself where that has no size."""
    parts = _shortest_tree(rest) if len(animation.triangles) == 0 else animation.triangles
    members, corners = np.unique(parts, return_inverse=True)
    members, corners = members.astype(np.int32), corners.reshape(parts.shape).astype(np.int32)
    at_rest = float(_sizes(np.ascontiguousarray(rest[None], np.float32), members, corners)[0])
    if not at_rest > 0:
        return animation
    return replace(animation, vertices=VerticesAtRestSize(animation.vertices, members, corners, at_rest))


def _sizes(
    block: Float32[np.ndarray, "frames V 3"], members: Int32[np.ndarray, "n"], corners: Int32[np.ndarray, "parts ends"]
) -> Float64[np.ndarray, "frames"]:
    """The root of the area of triangles, or the length of lines."""
    rows = np.empty((len(members), 3, len(block)), np.float32)
    gather_rows(block, members, rows)
    if corners.shape[1] == 2:
        apart = rows[corners[:, 0]].astype(np.float64) - rows[corners[:, 1]]
        return np.asarray(np.sqrt(np.einsum("pcf,pcf->pf", apart, apart)).sum(axis=0))
    twice = np.zeros(len(block), np.float64)
    descriptors.add_areas(rows, corners, twice)
    return np.sqrt(twice / 2)


def _shortest_tree(rest: Float32[np.ndarray, "V 3"]) -> Int[np.ndarray, "lines 2"]:
    """The lines of least length in all that join up to `POINTS` points, spread over those there are (Prim 1957)."""
    points = sample_farthest_points(rest, POINTS, np.ones(len(rest), bool)).chosen
    place = rest[points].astype(np.float64)
    lines = np.empty((len(points) - 1, 2), np.int64)
    distance, nearest = np.linalg.norm(place - place[0], axis=1), np.zeros(len(points), np.int64)
    distance[0] = np.inf
    for number in range(len(lines)):
        joined = int(np.argmin(distance))
        lines[number] = points[nearest[joined]], points[joined]
        closer = (np.linalg.norm(place - place[joined], axis=1) < distance) & np.isfinite(distance)
        distance[joined] = np.inf
        closer[joined] = False
        nearest[closer] = joined
        distance[closer] = np.linalg.norm(place[closer] - place[joined], axis=1)
    return lines
