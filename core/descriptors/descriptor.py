"""What a descriptor is: it measures every column of a body, triangle by triangle, on a block of frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float32

from caesura.core.animation import Animation
from caesura.core.descriptors.pair_distances import PairDistances
from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.mesh.mesh import Mesh
from caesura.core.mesh.welding import weld_vertices
from caesura.core.parameters import Parameters


@runtime_checkable
class Descriptor(Protocol):
    """Values of a body: of its triangles, or of its pairs of points where it has none that change."""

    @property
    def columns(self) -> int:
        """How many values there are in a frame."""

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and their value ≥ 0 in every frame; each array lives until the next."""

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The value that rounding alone gives each column where coordinates go up to `reach`."""


@dataclass(frozen=True)
class DescriptorInput:
    """What is measured. `strain` knows which triangles have area, and their order; the rest is made when asked."""

    animation: Animation
    rest: Float32[np.ndarray, "V 3"]
    strain: TriangleStrain
    parameters: Parameters

    @cached_property
    def mesh(self) -> Mesh:
        """The same triangles, in the same order, welded."""
        triangles = self.animation.triangles[self.strain.triangles]
        return Mesh.of(self.rest, triangles, weld_vertices(self.animation, self.rest))

    @cached_property
    def pairs(self) -> PairDistances:
        """Pairs of points that are spread over the rest shape."""
        return PairDistances.of(self.rest, self.animation.triangles)
