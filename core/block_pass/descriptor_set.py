"""The descriptors of a body, their patch means and its pair distances, all prepared from the rest shape."""

from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.animation import Animation
from caesura.core.descriptors.descriptor import Descriptor, DescriptorInput
from caesura.core.descriptors.pair_distances import PairDistances
from caesura.core.descriptors.pair_strain import PairStrain
from caesura.core.descriptors.patch_means import PatchMeans
from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.errors import InvalidModel
from caesura.core.kernels.descriptors import TILE
from caesura.core.mesh.patches import assign_patches
from caesura.core.mesh.triangle_order import order_triangles
from caesura.core.parameters import Parameters
from caesura.core.registry.descriptors import DESCRIPTORS, PAIR_DISTANCES
from caesura.core.segmentation_document import Notice


@dataclass(frozen=True)
class SurfaceDescriptor:
    """A descriptor of the triangles by its name, and the patches on which its means are taken."""

    name: str
    descriptor: Descriptor
    patches: PatchMeans

    def means(self, vertices: Float32[np.ndarray, "frames V 3"]) -> Float32[np.ndarray, "frames patches"]:
        """Its mean on each patch in every frame."""
        means = self.patches.empty(len(vertices))
        if self.patches.patches:
            for columns, tile in self.descriptor.tiles(vertices):
                self.patches.add(columns, tile, means)
        return means.T


@dataclass(frozen=True)
class DescriptorSet:
    """What is measured on every frame.

    `surface` is the descriptor of which the energy curve is made: strain, or another. With its means on patches, those
    of `others`, and the pair distances it describes the frames. `with_pairs`: whether the distances were asked for;
    measured they are always, for they are all that is left where nothing else changes.
    """

    surface: Descriptor
    patches: PatchMeans
    pairs: PairDistances
    name: str = "strain"
    others: tuple[SurfaceDescriptor, ...] = ()
    with_pairs: bool = True
    triangles: Int[np.ndarray, "_"] = field(default_factory=lambda: np.zeros(0, np.int64))
    """The triangle of the animation that each column of `surface` is of; none where they are pairs of points."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of what `measure_features` gives, in that order."""
        return (self.name, *(other.name for other in self.others), PAIR_DISTANCES)

    def measure_features(self, vertices: Float32[np.ndarray, "frames V 3"]) -> tuple[np.ndarray, ...]:
        """Patch means of every descriptor (frames, patches), then pair distances (frames, pairs)."""
        first = SurfaceDescriptor(self.name, self.surface, self.patches)
        return (*(one.means(vertices) for one in (first, *self.others)), self.pairs.measure(vertices))

    @classmethod
    def of(
        cls, animation: Animation, rest: Float32[np.ndarray, "V 3"], parameters: Parameters
    ) -> "tuple[DescriptorSet, tuple[Notice, ...]]":
        """The chosen descriptors of the triangles, or of pairs of points where there are none; and what must be said.

        Raises `InvalidModel` where there are triangles and none has area at rest.
        """
        triangles, chosen = animation.triangles, parameters.descriptor_names
        if len(triangles) == 0:
            return _of_skeleton(PairDistances.of(rest, triangles), chosen)
        patch = assign_patches(rest, triangles)
        order = order_triangles(rest, triangles, TILE)
        strain = TriangleStrain.of(rest, triangles, order, parameters.strain)
        if strain.columns == 0:
            detail = "No triangle of the rest shape has area, so nothing can be strained. Send a mesh with a surface."
            raise InvalidModel("degenerate-mesh", detail, pointer="/meshes" if animation.gltf is not None else None)
        subject = DescriptorInput(animation, rest, strain, parameters)
        means = PatchMeans.of(patch[strain.triangles], strain.areas)
        found = [
            SurfaceDescriptor(name, entry.load()(subject), means if entry.per_triangle else NO_PATCHES)
            for name, entry in ((name, DESCRIPTORS[name]) for name in chosen)
        ]
        first, *others = found
        name = first.name if first.patches.patches else "strain"
        apart = tuple(other for other in others if other.patches.patches)
        columns = strain.triangles if first.patches.patches else strain.triangles[:0]
        with_pairs = PAIR_DISTANCES in chosen
        body = cls(first.descriptor, first.patches, subject.pairs, name, apart, with_pairs, columns)
        return body, _left_out_notice(strain)

    def by_pairs(self) -> "DescriptorSet":
        """The same body, with the strain of its pairs of points in place of its triangles'."""
        return replace(self, surface=PairStrain.of(self.pairs), patches=NO_PATCHES, triangles=self.triangles[:0])


NO_PATCHES = PatchMeans.of(np.zeros(0, np.int64), np.zeros(0))


def _of_skeleton(pairs: PairDistances, chosen: tuple[str, ...]) -> tuple[DescriptorSet, tuple[Notice, ...]]:
    """Strain is that of the limbs, whatever descriptor of triangles was chosen."""
    notice = Notice(
        code="no-mesh-skeleton",
        detail="There is no mesh: the motions are those of the joints, by their distances from each other.",
    )
    limbs = PairStrain.of_limbs(pairs)
    each = PatchMeans.of(np.arange(limbs.columns), np.ones(limbs.columns))
    strains = chosen != (PAIR_DISTANCES,)
    with_pairs = PAIR_DISTANCES in chosen
    return DescriptorSet(limbs, each if strains else NO_PATCHES, pairs, with_pairs=with_pairs), (notice,)


def _left_out_notice(strain: TriangleStrain) -> tuple[Notice, ...]:
    if strain.left_out == 0:
        return ()
    every = strain.left_out + strain.columns
    detail = f"{strain.left_out} of {every} triangles have no area at rest and were left out."
    return (Notice(code="degenerate-triangles", detail=detail),)
