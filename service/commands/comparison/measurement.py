"""What every method finds in a labelled take: told the number of motions and told nothing, with time and memory."""

import tracemalloc
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np
from jaxtyping import Int

from caesura.core.agreement import boundary_scores, cut_frames, error_measure, frame_accuracy
from caesura.core.analysis import Analysis
from caesura.core.errors import ParameterError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.core.registry.methods import METHODS
from caesura.file_sources import open_parts
from caesura.formats.read import read_animation
from caesura.mapped_files import scratch_buffer
from caesura.service.commands.comparison.labelled_takes import LabelledTake
from caesura.service.commands.frame_labels import Labelling
from caesura.service.commands.label_files.read import read_frame_labels

TOLERANCE_SECONDS = 0.5
MEGABYTE = 2**20


@dataclass(frozen=True)
class Figures:
    """One labelling against the truth: shares, 0 to 1. `error` is Eq. 6; `f1` that of cuts within half a second."""

    accuracy: float
    error: float
    f1: float
    exact: bool
    """Whether the number of motions is right."""

    @classmethod
    def of(cls, labels: Int[np.ndarray, "frames"], truth: Int[np.ndarray, "frames"], frame_rate: float) -> "Figures":
        """The figures of one labelling."""
        tolerance = round(TOLERANCE_SECONDS * frame_rate)
        return cls(
            frame_accuracy(labels, truth),
            error_measure(labels, truth),
            boundary_scores(cut_frames(labels), cut_frames(truth), tolerance).f1,
            len(np.unique(labels)) == len(np.unique(truth)),
        )


@dataclass(frozen=True)
class MeasuredMethod:
    """One method on one take. `told`: given K; `untold`: given nothing, None where it cannot choose K itself.

    `seconds` and `megabytes` (the most that Python and NumPy held at once) are of the cut alone, given K. `refused`
    says why there are no figures.
    """

    take: str
    method: str
    told: Figures | None = None
    untold: Figures | None = None
    seconds: float = 0.0
    megabytes: float = 0.0
    refused: str = ""

    def document(self) -> dict[str, Any]:
        """As JSON values."""
        return asdict(self)


def measure_take(
    take: LabelledTake, methods: Sequence[str], parameters: Parameters, threads: int, tier: str | None
) -> Iterator[MeasuredMethod]:
    """Every method on one take; what they have in common, the analysis of the vertices, is made once."""
    animation = read_animation(open_parts([take.path, *take.companions]), parameters, Limits.none(), scratch_buffer)
    frames = Labelling(animation.frame_rate, animation.frames, (), animation.start_seconds)
    names = read_frame_labels(take.labels, frames, tier)
    truth = np.unique(names, return_inverse=True)[1]
    analysis = analyse(animation, parameters, threads=threads)
    for method in methods:
        yield _measure_method(str(take.path), analysis, truth, parameters.model_copy(update={"method": method}))


def _measure_method(
    take: str, analysis: Analysis, truth: Int[np.ndarray, "frames"], parameters: Parameters
) -> MeasuredMethod:
    told = parameters.model_copy(update={"motions": len(np.unique(truth))})
    try:
        start = perf_counter()
        labels = cut(replace(analysis), told).labels  # a copy, which knows nothing of the methods before
        seconds = perf_counter() - start
        figures, untold = Figures.of(labels, truth, analysis.frame_rate), None
        if not METHODS[parameters.method].needs_motions:
            untold = Figures.of(
                cut(replace(analysis), parameters.model_copy(update={"motions": "auto"})).labels,
                truth,
                analysis.frame_rate,
            )
        return MeasuredMethod(take, parameters.method, figures, untold, seconds, _peak_megabytes(analysis, told))
    except ParameterError as refused:
        return MeasuredMethod(take, parameters.method, refused=str(refused))


def _peak_megabytes(analysis: Analysis, parameters: Parameters) -> float:
    """In a second run, for counting takes time."""
    counting = tracemalloc.is_tracing()
    if not counting:
        tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        cut(replace(analysis), parameters)
        return (tracemalloc.get_traced_memory()[1] - before) / MEGABYTE
    finally:
        if not counting:
            tracemalloc.stop()
