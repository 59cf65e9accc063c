"""Animations added to a collection: each is segmented alone first, and compared by that result. Blocks."""

import time
from collections.abc import Sequence

from caesura.core.parameters import Parameters
from caesura.service.backend import Backend
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.submission import submit_segmentation
from caesura.worker.queue.collection_jobs import submit_labelling
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.records.record_types import AnimationRecord


def find_animations(backend: Backend, owner: str, identifiers: Sequence[str]) -> list[AnimationRecord]:
    """The owner's animations, each once; raises `RequestProblem` ("not-found") for the first that there is not."""
    found = []
    for identifier in dict.fromkeys(identifiers):
        animation = backend.jobs.records.animations.one(identifier)
        if animation is None or animation.owner != owner:
            raise RequestProblem("not-found", f"There is no animation {identifier}. It may have been deleted.")
        found.append(animation)
    return found


def add_animations(backend: Backend, identifier: str, animations: Sequence[AnimationRecord]) -> CollectionRecord:
    """Have animations labelled in the motions of a collection; those that are in it stay as they are.

    Raises `RequestProblem` ("too-many-takes", "not-found"), and what the submission of a segmentation raises.
    """
    collections = backend.jobs.records.collections
    known = collections.entries(identifier)
    fresh = [animation for animation in animations if animation.id not in known]
    _check_size(backend, len(known) + len(fresh), [entry.seconds for entry in known.values()], fresh)
    takes = tuple(_take(backend, animation, place) for place, animation in enumerate(fresh))

    def change(record: CollectionRecord) -> CollectionChange | None:
        present = collections.entries(identifier)
        put = tuple(take for take in takes if take.animation not in present)
        _check_size(backend, len(present) + len(put), [], [])
        return CollectionChange(record.model_copy(update={"updated": time.time()}), put)

    record = collections.change(identifier, change)
    if record is None:
        raise RequestProblem("not-found", f"There is no collection {identifier}. It may have been deleted.")
    if fresh:
        submit_labelling(backend.jobs, identifier)
    return record


def _take(backend: Backend, animation: AnimationRecord, place: int) -> TakeRecord:
    segmentation = submit_segmentation(backend, animation, Parameters.parse({}), animation.name)
    return TakeRecord(
        animation=animation.id,
        segmentation=segmentation.id,
        name=animation.name,
        added=time.time() + place * 1e-6,  # in order, and no two at once: pages go by it
        seconds=animation.seconds or 0.0,
    )


def _check_size(backend: Backend, takes: int, seconds: Sequence[float], fresh: Sequence[AnimationRecord]) -> None:
    settings = backend.settings
    if takes > settings.max_collection_takes:
        raise RequestProblem(
            "too-many-takes",
            f"A collection has at most {settings.max_collection_takes} takes here, and this would be {takes}.",
            limit=settings.max_collection_takes,
            actual=takes,
            setting="CAESURA_MAX_COLLECTION_TAKES",
        )
    length = sum(seconds) + sum(animation.seconds or 0.0 for animation in fresh)
    if length > settings.max_collection_seconds:
        raise RequestProblem(
            "too-many-takes",
            f"The takes of a collection last {settings.max_collection_seconds:g} seconds together at most here, and "
            f"these would last {length:g}.",
            limit=settings.max_collection_seconds,
            actual=length,
            setting="CAESURA_MAX_COLLECTION_SECONDS",
        )
