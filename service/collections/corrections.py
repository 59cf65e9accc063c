"""What people say of a collection: names and colours of motions, and the segments of a take. Blocks."""

import time
from collections.abc import Callable

from caesura.core.errors import ParameterError
from caesura.service.backend import Backend
from caesura.service.collections.requests import Correction, MotionChange
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.collections.common_motions import add_motions, new_motion_id, new_motions
from caesura.worker.collections.corrected_takes import Range, correct_take
from caesura.worker.records.collection_types import CollectionRecord, MotionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange


def check_name(name: str, pointer: str = "/name") -> str:
    """The name without blanks around it; raises `ParameterError` where it does not print."""
    plain = name.strip()
    if not plain or not plain.isprintable():
        raise ParameterError("invalid-parameter", "The name must be one line that prints.", pointer=pointer)
    return plain


def change_motion(backend: Backend, identifier: str, motion: str, wanted: MotionChange) -> CollectionRecord:
    """Call a motion otherwise, or give it another colour. Raises `RequestProblem` ("not-found", "name-taken")."""
    name = None if wanted.name is None else check_name(wanted.name)

    def change(record: CollectionRecord) -> CollectionChange:
        kept = next((one for one in record.motions if one.id == motion), None)
        if kept is None:
            raise RequestProblem("not-found", f"The collection has no motion {motion}.")
        _check_free(record, kept, name)
        update = {"name": name or kept.name, "named": kept.named or name is not None}
        changed = kept.model_copy(update={**update, "colour": wanted.colour or kept.colour})
        motions = tuple(changed if one.id == motion else one for one in record.motions)
        return CollectionChange(record.model_copy(update={"motions": motions, "updated": time.time()}))

    return _changed(backend, identifier, change)


def _check_free(record: CollectionRecord, motion: MotionRecord, name: str | None) -> None:
    other = next((one for one in record.motions if one.id != motion.id and name and _same(one.name, name)), None)
    if other is not None:
        detail = f"{other.name!r} is the name of another motion, {other.id}. Take another name."
        raise RequestProblem("name-taken", detail, parameter="name")


def _same(one: str, other: str) -> bool:
    return one.casefold() == other.casefold()


def correct_segments(
    backend: Backend, identifier: str, animation: str, wanted: Correction, expected: int | None
) -> tuple[TakeRecord, bool]:
    """The take with its segments as a person has set them, and whether any of them is new.

    Raises `RequestProblem` ("not-found", "stale-take", "not-finished") and `ParameterError`.
    """
    collections = backend.jobs.records.collections
    names = list(dict.fromkeys(check_name(one.name) for one in wanted.segments if one.name and not one.motion))
    identifiers = {name.casefold(): new_motion_id() for name in names}
    kept: list[TakeRecord] = []
    fresh = False

    def change(record: CollectionRecord) -> CollectionChange:
        nonlocal fresh
        take = next(iter(collections.takes(identifier, [animation])), None)
        _check_correctable(take, animation, expected)
        assert take is not None  # noqa: S101  checked above
        known = {one.name.casefold(): one.id for one in record.motions}
        missing = [name for name in names if name.casefold() not in known]
        made = new_motions(record.motions, [identifiers[name.casefold()] for name in missing], missing)
        known |= {one.name.casefold(): one.id for one in made}
        corrected = correct_take(take, _ranges(wanted, known))
        fresh = corrected.segments != take.segments
        kept[:] = [corrected if fresh else take]
        return CollectionChange(add_motions(record, made), tuple(kept))

    _changed(backend, identifier, change)
    return kept[0], fresh


def _check_correctable(take: TakeRecord | None, animation: str, expected: int | None) -> None:
    if take is None:
        raise RequestProblem("not-found", f"The collection has no animation {animation}.")
    if take.status != "labelled":
        raise RequestProblem("not-finished", f"The take is {take.status}: there is nothing to correct yet.")
    if expected is not None and expected != take.version:
        detail = f"The take was changed meanwhile: it has version {take.version}. Load it, then correct it again."
        raise RequestProblem("stale-take", detail, current=take.version)


def _ranges(wanted: Correction, known: dict[str, str]) -> list[Range]:
    found = []
    for number, one in enumerate(wanted.segments):
        motion = one.motion or known.get((one.name or "").strip().casefold(), "")
        if motion not in known.values():
            detail = "It names no motion of the collection: give `motion`, the id of one, or `name`."
            raise ParameterError("invalid-segments", detail, pointer=f"/segments/{number}")
        found.append((one.start, one.end, motion))
    return found


def _changed(
    backend: Backend, identifier: str, change: Callable[[CollectionRecord], CollectionChange]
) -> CollectionRecord:
    record = backend.jobs.records.collections.change(identifier, change)
    if record is None:
        raise RequestProblem("not-found", f"There is no collection {identifier}. It may have been deleted.")
    return record
