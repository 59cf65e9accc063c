"""The descriptors by name: to add one, write its file and add its line here. Light: no NumPy.

Parameters, the API's schemas and the command's help read this table. Whatever is chosen, the rest of the method is the
same: quantisation, joint histogram, energy, key-frames.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from caesura.core.descriptors.descriptor import Descriptor, DescriptorInput


@dataclass(frozen=True)
class DescriptorEntry:
    """One thing to measure: its name, the place of its class below `core.descriptors`, what it is, and its unit."""

    name: str
    place: str
    description: str
    unit: str = "no unit"
    per_triangle: bool = True
    """Whether its columns are the triangles; else they are pairs of points, which have no place on the surface."""

    def load(self) -> "Callable[[DescriptorInput], Descriptor]":
        """Its `from_input`, imported at its first use: all but the default bring sparse matrices."""
        module, _, name = self.place.partition(":")
        made: Callable[[DescriptorInput], Descriptor] = getattr(
            import_module(f"caesura.core.descriptors.{module}"), name
        ).from_input
        return made


PAIR_DISTANCES = "pair-distances"

DESCRIPTORS = {
    entry.name: entry
    for entry in (
        DescriptorEntry("strain", "strain:TriangleStrain", "how far each triangle is stretched (paper, section 3)"),
        DescriptorEntry(
            PAIR_DISTANCES, "pair_strain:PairStrain", "how far pairs of points are stretched", per_triangle=False
        ),
        DescriptorEntry("geodesic", "geodesic:Geodesic", "how far it is along the surface to the rest of the body"),
        DescriptorEntry("heat-kernel", "heat_kernel:HeatKernel", "how much of a drop of heat stays where it fell"),
        DescriptorEntry(
            "curvature", "curvature:Curvature", "how round or flat the surface is", "radians, or no unit where `mean`"
        ),
    )
}
