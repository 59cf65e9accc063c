"""The method in order: from vertices to an analysis, from an analysis to segments. Arithmetic is elsewhere."""

from collections.abc import Iterable, Iterator

import numpy as np
from threadpoolctl import threadpool_limits

from caesura.core.analysis import Analysis
from caesura.core.animation import Animation
from caesura.core.block_pass.body_size import scale_to_rest_size
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.features import extract_features
from caesura.core.block_pass.rest_pose import compute_rest_pose
from caesura.core.block_pass.strain_at_peaks import measure_strain_at_peaks
from caesura.core.block_pass.vertex_pass import PassResult, run_block_pass
from caesura.core.energy.energy_curve import compute_energy_curve, frames_per_window
from caesura.core.energy.frame_distance import compute_distance_curve
from caesura.core.energy.key_frames import find_local_maxima
from caesura.core.errors import InvalidModel
from caesura.core.parameters import ALGORITHM, Parameters
from caesura.core.progress import Progress, ignore_progress
from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.core.registry.methods import METHODS
from caesura.core.repetition.loops import LoopFinder, find_loops
from caesura.core.repetition.repetitions import RepetitionFinder, find_repetitions
from caesura.core.segmentation import Segmentation, number_by_appearance
from caesura.core.segmentation_document import Notice, Source

CODES_BYTES = 128 * 2**20
"""Memory for the codes of strains; those of frames that do not fit are computed twice."""


def analyse(
    animation: Animation,
    parameters: Parameters | None = None,
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
    memory_bytes: int = CODES_BYTES,
    peak_strain: bool = True,
) -> Analysis:
    """Everything that needs the vertices. Memory does not grow with the frames, but for the results themselves.

    Without `peak_strain` its columns are left out, and only methods that do not read it can cut the analysis.

    Raises `InvalidModel`: `no-motion` below two frames, `degenerate-mesh` where no triangle has area at rest,
    `non-finite-data` naming frame and vertex. The same bytes for any number of threads.
    """
    parameters = parameters or Parameters()
    if animation.frames < 2:
        place = f"/animations/{animation.take.index}" if animation.gltf is not None else None
        detail = "The take has a single frame: nothing moves. Choose a take with a motion."
        raise InvalidModel("no-motion", detail, pointer=place)
    with threadpool_limits(1):
        progress("rest shape", 0.0)
        rest = compute_rest_pose(animation, parameters.rest)
        if parameters.scale_invariant:
            animation = scale_to_rest_size(animation, rest)
        body, notices = DescriptorSet.of(animation, rest, parameters)
        take = run_block_pass(
            animation, body, parameters, threads=threads, progress=progress, memory_bytes=memory_bytes
        )
        if not take.has_strain and take.has_pair_changes:
            body = body.by_pairs()
            take = run_block_pass(
                animation, body, parameters, threads=threads, progress=progress, memory_bytes=memory_bytes
            )
        scale = take.scale(parameters.normalize)
        length = frames_per_window(parameters.energy, parameters.window_seconds, animation.frame_rate)
        if parameters.energy == "distance":
            energy = compute_distance_curve(take.normalised_strains(scale, progress), animation.frames)
        else:
            bins = take.bins(scale, parameters.bins, progress)
            energy = compute_energy_curve(bins, animation.frames, length, parameters.bins, take.threads)
        peaks = find_local_maxima(energy)
        strain_at_peaks = np.zeros((len(peaks), 0), np.float32)
        if peak_strain:
            strain_at_peaks = measure_strain_at_peaks(animation, body, peaks, scale, threads, progress)
        return Analysis(
            frames=animation.frames,
            frame_rate=animation.frame_rate,
            source=_describe_source(animation),
            heavy=parameters.heavy(),
            energy=energy,
            peaks=peaks,
            peak_strain=strain_at_peaks,
            peak_triangles=body.triangles if strain_at_peaks.shape[1] == len(body.triangles) else body.triangles[:0],
            features=extract_features(
                take.block_pass.projections,
                take.features,
                take.changing,
                body.names,
                with_pairs=body.with_pairs,
            ),
            strain_scale=scale,
            threads=threads,
            notices=animation.notices + notices + _notices(animation, take, length, parameters.descriptor),
        )


def segment(
    animation: Animation,
    parameters: Parameters | None = None,
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
    memory_bytes: int = CODES_BYTES,
) -> Segmentation:
    """The motions of an animation: `analyse`, then `cut`."""
    parameters = parameters or Parameters()
    analysis = analyse(
        animation,
        parameters,
        threads=threads,
        progress=progress,
        memory_bytes=memory_bytes,
        peak_strain=METHODS[parameters.method].reads_peak_strain,
    )
    progress("cut", 0.0)
    return cut(analysis, parameters)


def cut(analysis: Analysis, parameters: Parameters) -> Segmentation:
    """The segments of an analysed take, by the method the parameters name. No vertices are touched."""
    found = METHODS[parameters.method].load()(analysis, parameters)
    labels = number_by_appearance(found.labels)
    changes = np.count_nonzero(np.diff(labels))
    repeats = find_repetitions(analysis.derived(RepetitionFinder.of), labels)
    return Segmentation(
        method=parameters.method,
        algorithm=ALGORITHM,
        parameters=parameters.model_dump(),
        source=analysis.source,
        frame_rate=analysis.frame_rate,
        labels=labels,
        energy=analysis.energy,
        key_frames=found.key_frames,
        confidence=np.ones(changes) if found.confidence is None else found.confidence,
        scores=found.scores,
        kind=found.kind,
        transitions=found.transitions,
        candidates=found.candidates,
        variances=found.variances,
        clusters=found.clusters,
        notices=analysis.notices + found.notices,
        repeats=repeats,
        loops=find_loops(analysis.derived(LoopFinder.of), labels, repeats),
    )


def cut_into_other_motion_counts(
    analysis: Analysis, parameters: Parameters, scored: Iterable[int], chosen: int
) -> Iterator[Segmentation]:
    """What `cut` answers for every number of motions that was scored when it chose one; the nearest to that first.

    What the cuts have in common is computed once, so that each takes a fraction of the first (`Analysis.derived`).
    """
    for motions in sorted(scored, key=lambda motions: (abs(motions - chosen), motions)):
        yield cut(analysis, parameters.model_copy(update={"motions": motions}))


def _describe_source(animation: Animation) -> Source:
    take = animation.take
    return Source(take=take.index, name=take.name, fps=animation.frame_rate, start_seconds=animation.start_seconds)


def _notices(animation: Animation, take: PassResult, length: int, descriptor: str) -> tuple[Notice, ...]:
    """What must be said of a take that cannot be cut as usual."""
    said = []
    if not take.has_strain and not take.has_pair_changes:
        detail = "The body moves as one rigid piece: nothing deforms, so the take is one segment."
        said.append(Notice(code="no-deformation", detail=detail))
    elif DESCRIPTORS[descriptor].per_triangle and len(animation.triangles) and not take.block_pass.body.patches.patches:
        what = "do not strain" if descriptor == "strain" else f"do not change by the descriptor {descriptor}"
        detail = f"The triangles of this mesh {what}, so the energy curve is of distances between its points."
        said.append(Notice(code="no-strain", detail=detail))
    if animation.frames < 2 * length:
        detail = (
            f"The take has {animation.frames} frames and the energy curve needs two windows of {length}: it is empty."
            " Send a smaller window_seconds."
        )
        said.append(Notice(code="shorter-than-windows", detail=detail))
    return tuple(said)
