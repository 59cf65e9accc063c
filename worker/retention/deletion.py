"""Deleting what was kept: blobs before the record that points to them, so that it can be repeated when cut short.

On a full disk Redis takes no writes, not even deletions. So all blobs of what is deleted go first: they make the room
that Redis then finds, and the records follow.
"""

import time
from collections.abc import Iterable, Iterator

from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import Records
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.records.connection import await_writable
from caesura.worker.records.record_types import AnimationRecord
from caesura.worker.store.blobs import Blobs

RESULT_FILES_WITH_UPLOAD = ("clips", "keyframes", "pictures", "poster")
"""Forms that hold what was uploaded: they go with it."""

WRITES_SECONDS = 3.0
"""Redis looks every second whether its disk has room again."""


def delete_segmentation(jobs: Jobs, blobs: Blobs, identifier: str) -> None:
    """Cancel a segmentation where it is live, and delete it with every file made of it; the analysis stays."""
    _delete_blobs(jobs, blobs, _result_file_blobs(jobs.records, identifier))
    _delete_all_result_files(jobs, blobs, identifier)
    jobs.delete(identifier)
    _delete_all_result_files(jobs, blobs, identifier)  # one that was kept in this moment; from now on none is


def delete_animation(jobs: Jobs, blobs: Blobs, animation: AnimationRecord) -> None:
    """Delete an upload and everything derived from it, also what is asked for while it is being deleted."""
    _delete_blobs(jobs, blobs, blobs_of_animation(jobs.records, animation))
    while True:
        for collection in jobs.records.collections.with_animation(animation.id):
            remove_from_collection(jobs, blobs, collection, animation.id)
        for segmentation in jobs.records.segmentations.of(animation.id):
            delete_segmentation(jobs, blobs, segmentation.id)
        delete_upload_files(jobs, blobs, animation)
        if jobs.records.animations.delete(animation):
            return


def delete_collection(jobs: Jobs, blobs: Blobs, collection: CollectionRecord) -> None:
    """Delete a collection with what its takes are compared by; the animations stay."""
    _delete_blobs(jobs, blobs, blobs_of_collection(jobs.records, collection.id))
    jobs.records.collections.delete(collection)


def remove_from_collection(jobs: Jobs, blobs: Blobs, identifier: str, animation: str) -> None:
    """Take an animation out of a collection, with what it is compared by."""
    collections = jobs.records.collections
    removed = collections.takes(identifier, [animation])
    collections.change(
        identifier,
        lambda record: CollectionChange(record.model_copy(update={"updated": time.time()}), removed=(animation,)),
    )
    for key in _blobs_of_takes(removed):
        blobs.delete(key)


def blobs_of_collection(records: Records, identifier: str) -> Iterator[str]:
    """Every blob of a collection: what its takes are compared by, and in."""
    collection = records.collections.one(identifier)
    if collection is not None and collection.space:
        yield collection.space
    yield from _blobs_of_takes(records.collections.all_takes(identifier))


def _blobs_of_takes(takes: Iterable[TakeRecord]) -> Iterator[str]:
    for take in takes:
        yield from take.numbers.blobs() if take.numbers is not None else ()


def _delete_blobs(jobs: Jobs, blobs: Blobs, keys: Iterator[str]) -> None:
    """Delete blobs, and wait until Redis takes writes, which it does at once where its disk was not full."""
    for key in keys:
        blobs.delete(key)
    await_writable(jobs.redis, WRITES_SECONDS)


def blobs_of_animation(records: Records, animation: AnimationRecord) -> Iterator[str]:
    """Every blob of an upload, and of what was made of it."""
    yield from (part.key for part in animation.parts)
    for analysis in records.analyses.all(animation.id).values():
        yield from analysis.blobs()
    for segmentation in records.segmentations.of(animation.id):
        yield from _result_file_blobs(records, segmentation.id)


def _result_file_blobs(records: Records, identifier: str) -> Iterator[str]:
    """The blobs of files made of a result."""
    made = (records.exports.one(identifier, form) for form in records.exports.forms(identifier))
    yield from (one.key for one in made if one is not None and one.key is not None)


def delete_upload_files(jobs: Jobs, blobs: Blobs, animation: AnimationRecord) -> None:
    """Delete an upload's files, what was computed from them, and copies of them in clips; results stay.

    So do its segments in collections; it is not searched there any more.
    """
    for collection in jobs.records.collections.with_animation(animation.id):
        _forget_numbers(jobs, blobs, collection, animation.id)
    for segmentation in jobs.records.segmentations.of(animation.id):
        for form in jobs.records.exports.forms(segmentation.id):
            if form.partition("?")[0] in RESULT_FILES_WITH_UPLOAD:
                delete_result_file(jobs.records, blobs, segmentation.id, form)
    for digest, analysis in jobs.records.analyses.all(animation.id).items():
        for key in analysis.blobs():
            blobs.delete(key)
        jobs.records.analyses.delete(animation.id, digest)
    for part in animation.parts:
        blobs.delete(part.key)


def _forget_numbers(jobs: Jobs, blobs: Blobs, identifier: str, animation: str) -> None:
    collections = jobs.records.collections
    kept = [take for take in collections.takes(identifier, [animation]) if take.numbers is not None]
    if kept:
        put = tuple(take.model_copy(update={"numbers": None}) for take in kept)
        collections.change(identifier, lambda record: CollectionChange(record, put))
    for key in _blobs_of_takes(kept):
        blobs.delete(key)


def _delete_all_result_files(jobs: Jobs, blobs: Blobs, identifier: str) -> None:
    for form in jobs.records.exports.forms(identifier):
        delete_result_file(jobs.records, blobs, identifier, form)


def delete_result_file(records: Records, blobs: Blobs, identifier: str, form: str) -> None:
    """Delete one file made of a result; asked for again, it is made again."""
    made = records.exports.one(identifier, form)
    if made is not None and made.key is not None:
        blobs.delete(made.key)
    records.exports.delete(identifier, form)


def delete_oldest_result_files(records: Records, blobs: Blobs, identifier: str, kept: int) -> None:
    """Delete all but the newest so many files made of a result: each may be as large as what was uploaded.

    So are forgotten answers that there is none, which are small but may be any number, and forms whose job was lost.
    """
    made = {form: records.exports.one(identifier, form) for form in records.exports.forms(identifier)}
    lost = [form for form, one in made.items() if one is None]
    over = sorted((one.created, form) for form, one in made.items() if one is not None and (one.key or one.problem))
    for form in [*lost, *(form for _, form in over[:-kept])]:
        delete_result_file(records, blobs, identifier, form)
