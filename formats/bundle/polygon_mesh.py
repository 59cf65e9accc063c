"""A surface of polygons, as OBJ and PLY have it, and the triangles of it."""

import warnings
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel


@dataclass(frozen=True)
class PolygonMesh:
    """Vertices, and polygons one after the other: the vertex at each corner, and how many corners each polygon has."""

    vertices: Float[np.ndarray, "V 3"]
    corners: Int[np.ndarray, "C"]
    sizes: Int[np.ndarray, "P"]

    def has_polygons_of(self, other: "PolygonMesh") -> bool:
        """Whether both have as many vertices, and the same polygons of them."""
        return (
            len(self.vertices) == len(other.vertices)
            and np.array_equal(self.sizes, other.sizes)
            and np.array_equal(self.corners, other.corners)
        )

    def triangles(self) -> Int[np.ndarray, "T 3"]:
        """Each polygon as a fan around its first corner; of triangles with the same three corners, the first."""
        counts = np.maximum(self.sizes - 2, 0)
        hub = np.repeat(np.cumsum(self.sizes) - self.sizes, counts)
        step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        fans = self.corners[np.stack([hub, hub + step + 1, hub + step + 2], axis=1)]
        first, second, third = np.sort(fans, axis=1).T
        order = np.lexsort((third, second, first))
        new = np.diff(np.stack([first, second, third])[:, order], prepend=-1).any(axis=0)
        return np.asarray(fans[np.sort(order[new])])


def malformed_shape(what: str) -> InvalidModel:
    """The refusal of a shape, whose name the caller puts before it."""
    return InvalidModel("malformed-shape", what)


def numbers(text: bytes) -> Float[np.ndarray, "N"]:
    """The numbers in a text of nothing else, with spaces or ends of lines between them. Raises `malformed-shape`."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text.strip(), np.float64, sep=" ")  # which makes -1 of a space alone
        except (ValueError, DeprecationWarning):
            raise malformed_shape("has something else where a number belongs") from None


def whole_numbers(values: Float[np.ndarray, "N"]) -> Int[np.ndarray, "N"]:
    """The same as integers. Raises `malformed-shape`."""
    if not ((np.abs(values) < 2.0**53) & (values == np.floor(values))).all():
        raise malformed_shape("has a face that names a vertex by no whole number")
    return values.astype(np.int64)
