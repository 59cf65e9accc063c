"""The files that the page plays of a take."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from caesura.core.analysis import Analysis
from caesura.core.animation import Animation
from caesura.core.block_pass.body_size import scale_to_rest_size
from caesura.core.block_pass.rest_pose import compute_rest_pose
from caesura.core.descriptors.descriptor import Descriptor, DescriptorInput
from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress, ignore_progress
from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.formats.playback.playable_gltf import write_playable_gltf
from caesura.formats.playback.strain_blocks import DisplayPatches, choose_display_patches, write_strain_blocks
from caesura.formats.playback.vertex_blocks import choose_display_mesh, write_vertex_blocks

WITHOUT_STRAIN = {"no-strain", "no-deformation"}
"""Notices of an analysis whose surface does not strain: there is nothing to colour."""


@dataclass(frozen=True)
class Playback:
    """`document` is what the service answers, without addresses. The streams can be read once, in any order.

    `materials` are those of the model with their images.

    They draw from the animation, so what it was read from must still be there.
    """

    document: dict[str, Any]
    model: Iterator[bytes]
    strain: Iterator[bytes] | None
    materials: Iterator[bytes] | None = None


def make_playback(
    animation: Animation,
    analysis: Analysis,
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
) -> Playback:
    """The model and its strain, to be written as they are read. `progress` hears the stage "figure" while they are."""
    surface = _patches(animation, analysis)
    of_vertex = np.zeros(animation.vertex_count, np.int64) if surface is None else surface.of_vertex
    shown = {"vertices": animation.vertex_count, "triangles": len(animation.triangles)}
    kind = "vertices" if animation.gltf is None else "gltf"
    materials = None
    if animation.gltf is not None:
        model, materials = write_playable_gltf(animation.gltf, animation.take.index, of_vertex)
    else:
        mesh = choose_display_mesh(animation)
        model = write_vertex_blocks(animation, mesh, of_vertex, threads=threads, progress=progress)
        shown = {"vertices": len(mesh.vertices), "triangles": len(mesh.triangles)}
    document = {
        "kind": kind,
        "frames": animation.frames,
        "frame_rate": animation.frame_rate,
        "start_seconds": animation.start_seconds,
        **shown,
        "skeleton": len(animation.triangles) == 0,
        "patches": 0 if surface is None else surface.means.patches,
    }
    strain = None
    if surface is not None:
        measured = _as_measured(animation, Parameters.model_validate(analysis.heavy))
        strain = write_strain_blocks(measured, surface, analysis.strain_scale, threads=threads, progress=progress)
    return Playback(document, model, strain, materials)


def _as_measured(animation: Animation, chosen: Parameters) -> Animation:
    """The animation with its size taken out where the analysis took it out."""
    return (
        scale_to_rest_size(animation, compute_rest_pose(animation, chosen.rest))
        if chosen.scale_invariant
        else animation
    )


def _patches(animation: Animation, analysis: Analysis) -> DisplayPatches | None:
    """The patches of a surface that strains, or changes by whatever descriptor was chosen."""
    if len(animation.triangles) == 0 or WITHOUT_STRAIN & {notice.code for notice in analysis.notices}:
        return None
    chosen = Parameters.model_validate(analysis.heavy)
    measured = DESCRIPTORS[chosen.descriptor]
    if not measured.per_triangle:
        return None
    rest = compute_rest_pose(animation, chosen.rest)

    def descriptor(strain: TriangleStrain) -> Descriptor:
        return measured.load()(DescriptorInput(animation, rest, strain, chosen))

    return choose_display_patches(rest, animation.triangles, animation.frames, chosen.strain, descriptor)
