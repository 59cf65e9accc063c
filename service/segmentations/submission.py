"""From an animation and parameters to a segmentation that is queued, or known already."""

import time
from collections.abc import Sequence

from caesura.core.parameters import ALGORITHM, Parameters
from caesura.core.registry.methods import METHODS
from caesura.formats.takes.take_selection import select_take
from caesura.service.backend import Backend
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker import logs
from caesura.worker.records import content_ids
from caesura.worker.records.record_types import AnimationRecord, SegmentationRecord, TakeSummary
from caesura.worker.stored_alternatives import restore_alternative

ALL = "all"


def resolve_parameters(parameters: Parameters, takes: Sequence[TakeSummary]) -> Parameters:
    """The same with the take by its index, so that its name, its index and `longest` are one segmentation.

    Raises `ParameterError` for a take that is not there. What a header does not tell is left to the worker, and so is
    `all` of several takes, none of which is called so.
    """
    names = [take.name for take in takes]
    if not takes or (parameters.take == ALL and ALL not in names and len(takes) > 1):
        return parameters
    place = select_take(names, "longest" if parameters.take == ALL and ALL not in names else parameters.take)
    if place is None:
        place = max(range(len(takes)), key=lambda index: takes[index].duration_seconds)
    return parameters.model_copy(update={"take": takes[place].index})


def submit_segmentation(
    backend: Backend, animation: AnimationRecord, parameters: Parameters, name: str
) -> SegmentationRecord:
    """The segmentation, queued now or before; done, where the answer was stored though nobody had asked for it.

    Blocks: run it on a thread.

    Raises `RequestProblem` ("gone") where it would have to be computed and the upload's files are no longer kept.
    """
    chosen = resolve_parameters(parameters, backend.jobs.records.animations.takes(animation))
    identifier = _identifier(backend, animation, chosen)
    now = time.time()
    wanted = SegmentationRecord(
        id=identifier,
        animation=animation.id,
        owner=animation.owner,
        name=name or animation.name,
        request=logs.request_id(),
        parameters=chosen.model_dump(),
        algorithm=ALGORITHM,
        created=now,
        updated=now,
    )
    if chosen.motions != "auto" and not METHODS[chosen.method].needs_motions:
        unasked = _identifier(backend, animation, chosen.model_copy(update={"motions": "auto"}))
        stored = restore_alternative(backend.jobs.records, wanted, unasked)
        if stored is not None:
            return stored
    if not animation.parts:
        kept = backend.jobs.records.segmentations.one(identifier)
        if kept is None or not kept.settled:
            raise RequestProblem(
                "gone", "The files of this animation are no longer kept. Upload it again to cut it anew."
            )
    return backend.jobs.submit(wanted)


def _identifier(backend: Backend, animation: AnimationRecord, chosen: Parameters) -> str:
    return content_ids.segmentation_id(backend.secret, animation.id, chosen.canonical(), ALGORITHM)
