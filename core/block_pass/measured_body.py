"""What is measured of a body: the descriptor, its means on patches, and pair distances; all of the rest shape."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32

from caesura.core.animation import Animation
from caesura.core.descriptors.pair_distances import PairDistances
from caesura.core.descriptors.pair_strain import PairStrain
from caesura.core.descriptors.patch_means import PatchMeans
from caesura.core.descriptors.strain import TILE, TriangleStrain
from caesura.core.descriptors.table import DESCRIPTORS, Descriptor, DescriptorInput
from caesura.core.document import Notice
from caesura.core.errors import InvalidModel
from caesura.core.mesh.patches import assign_patches
from caesura.core.mesh.triangle_order import order_triangles
from caesura.core.parameters import Parameters


@dataclass(frozen=True)
class MeasuredBody:
    """What is measured on every frame: the descriptor, strain or another, its means on patches, and pair distances."""

    surface: Descriptor
    patches: PatchMeans
    pairs: PairDistances

    def describe(self, vertices: Float32[np.ndarray, "frames V 3"]) -> tuple[np.ndarray, np.ndarray]:
        """Patch means of strain (frames, patches) and pair distances (frames, pairs)."""
        means = self.patches.empty(len(vertices))
        if self.patches.patches:
            for columns, tile in self.surface.tiles(vertices):
                self.patches.add(columns, tile, means)
        return means.T, self.pairs.measure(vertices)

    @classmethod
    def of(
        cls, animation: Animation, rest: Float32[np.ndarray, "V 3"], parameters: Parameters
    ) -> "tuple[MeasuredBody, tuple[Notice, ...]]":
        """The chosen descriptor of the triangles, or of pairs of points where there are none; and what must be said.

        Raises `InvalidModel` where there are triangles and none has area at rest.
        """
        triangles = animation.triangles
        pairs = PairDistances.of(rest, triangles)
        if len(triangles) == 0:
            notice = Notice(
                code="no-mesh-skeleton",
                detail="There is no mesh: the motions are those of the joints, by their distances from each other.",
            )
            limbs = PairStrain.of_limbs(pairs)
            each = PatchMeans.of(np.arange(limbs.columns), np.ones(limbs.columns))
            return cls(limbs, each, pairs), (notice,)
        patch = assign_patches(rest, triangles)
        order = order_triangles(rest, triangles, TILE)
        strain = TriangleStrain.of(rest, triangles, order, parameters.strain, parameters.scale_invariant)
        if strain.columns == 0:
            detail = "No triangle of the rest shape has area, so nothing can be strained. Send a mesh with a surface."
            raise InvalidModel("degenerate-mesh", detail, pointer="/meshes" if animation.gltf is not None else None)
        if parameters.descriptor == "pair-distances":
            return cls(PairStrain.of(pairs), NO_PATCHES, pairs), _left_out_notice(strain)
        surface = DESCRIPTORS[parameters.descriptor](DescriptorInput(animation, rest, strain, parameters))
        return cls(surface, PatchMeans.of(patch[strain.triangles], strain.areas), pairs), _left_out_notice(strain)

    def by_pairs(self) -> "MeasuredBody":
        """The same body, with the strain of its pairs of points in place of its triangles'."""
        return MeasuredBody(PairStrain.of(self.pairs), NO_PATCHES, self.pairs)


NO_PATCHES = PatchMeans.of(np.zeros(0, np.int64), np.zeros(0))


def _left_out_notice(strain: TriangleStrain) -> tuple[Notice, ...]:
    if strain.left_out == 0:
        return ()
    every = strain.left_out + strain.columns
    detail = f"{strain.left_out} of {every} triangles have no area at rest and were left out."
    return (Notice(code="degenerate-triangles", detail=detail),)
