"""The motions of a collection: how a new one is called and shown, and how a person changes that. Light: no NumPy."""

import secrets
import time
from collections.abc import Iterable
from itertools import count

from caesura.core.plot.layout import COLOURS
from caesura.core.segmentation_document import motion_name
from caesura.worker.records.collection_types import CollectionRecord, MotionRecord


def new_motion_id() -> str:
    """An id that no other motion has, of this collection or another, now or later."""
    return f"m{secrets.token_hex(5)}"


def new_motions(
    kept: Iterable[MotionRecord], identifiers: Iterable[str], names: Iterable[str] = ()
) -> list[MotionRecord]:
    """Motions of these ids beside those that are kept: with the names given, then the letters that are free."""
    known = list(kept)
    given, made = list(names), []
    for identifier in identifiers:
        name = given.pop(0) if given else ""
        motion = MotionRecord(
            id=identifier, name=name or _free_name(known), colour=_free_colour(known), named=bool(name)
        )
        known.append(motion)
        made.append(motion)
    return made


def add_motions(record: CollectionRecord, motions: Iterable[MotionRecord]) -> CollectionRecord:
    """The collection with more motions; one whose letter or colour was taken meanwhile gets another."""
    kept = list(record.motions)
    for motion in motions:
        if any(one.id == motion.id for one in kept):
            continue
        taken = any(one.name.casefold() == motion.name.casefold() for one in kept)
        name = _free_name(kept) if taken else motion.name
        colour = _free_colour(kept) if any(one.colour == motion.colour for one in kept) else motion.colour
        kept.append(motion.model_copy(update={"name": name, "colour": colour, "named": motion.named and not taken}))
    return record.model_copy(update={"motions": tuple(kept), "updated": time.time()})


def _free_name(known: Iterable[MotionRecord]) -> str:
    taken = {motion.name.casefold() for motion in known}
    return next(name for name in map(motion_name, count()) if name.casefold() not in taken)


def _free_colour(known: Iterable[MotionRecord]) -> str:
    """The first of those that the fewest motions have."""
    shown = [motion.colour for motion in known]
    return min(COLOURS, key=shown.count)
