"""Search by example: ranges of the takes of a collection that are like a range of an animation, bent in time."""

from caesura.core.errors import InvalidModel
from caesura.core.together.example_search import ExampleIndex, IndexedTake, cut_example, index_take
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import measure, read_searched
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.thread_count import available_threads
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import CollectionRecord, FoundRange, SearchRecord, TakeRecord
from caesura.worker.store.blobs import BlobMissing


def find_example(here: WorkerContext, record: CollectionRecord, search: SearchRecord) -> tuple[FoundRange, ...]:
    """The ranges that are like the example, nearest first; the example itself is not among them.

    Raises `InvalidModel` ("nothing-to-search") without takes to search, and what
    the measuring of an animation that is not in the collection raises.
    """
    record, takes, indexed = _read_index(here, record)
    if not record.space or not indexed:
        raise InvalidModel("nothing-to-search", "No take of the collection is labelled and still kept with its file.")
    stored = StoredSpace.from_bytes(here.blobs.read(record.space))
    inside = next((one for one in indexed if one.name == search.animation), None)
    example = inside or _measured_example(here, search, stored)
    asked = cut_example(example, search.start, search.end or example.frames)
    index = ExampleIndex(stored.space, tuple(indexed))
    threads = here.settings.threads or available_threads()
    ranges = index.find(asked, search.limit + 1, threads=threads)
    own = (search.animation, search.start, search.end or example.frames)
    others = [one for one in ranges if not _overlaps((one.take, one.start, one.end), own)]
    return tuple(_found(takes[one.take], one.start, one.end, one.distance) for one in others[: search.limit])


def _read_index(
    here: WorkerContext, record: CollectionRecord
) -> tuple[CollectionRecord, dict[str, TakeRecord], list[IndexedTake]]:
    """The labelled takes, and what is searched of them, all in one pose space: it may be learned anew meanwhile."""
    collections = here.jobs.records.collections
    while True:
        entries = collections.entries(record.id)
        takes = {take.animation: take for take in collections.takes(record.id, entries) if take.status == "labelled"}
        indexed = [one for one in (_indexed(here, take) for take in takes.values()) if one is not None]
        now = collections.one(record.id)
        if now is None or now.space == record.space:
            return record, takes, indexed
        record = now


def _indexed(here: WorkerContext, take: TakeRecord) -> IndexedTake | None:
    try:
        return read_searched(here.blobs, take)
    except BlobMissing:
        return None


def _measured_example(here: WorkerContext, search: SearchRecord, stored: StoredSpace) -> IndexedTake:
    """An animation that is not in the collection, as it is searched."""
    segmentation = here.jobs.records.segmentations.one(search.segmentation)
    if segmentation is None or segmentation.status != "done":
        raise BlobMissing(search.animation)
    quota = JobQuota(here.settings.job_memory_bytes, here.settings.job_seconds)
    measured, _ = measure(here, quota, segmentation)
    return index_take(stored.space, measured.name, measured.poses)


def _overlaps(one: tuple[str, int, int], other: tuple[str, int, int]) -> bool:
    """Whether a range is mostly another of the same take."""
    shared = min(one[2], other[2]) - max(one[1], other[1])
    return one[0] == other[0] and 2 * shared > min(one[2] - one[1], other[2] - other[1])


def _found(take: TakeRecord, start: int, end: int, distance: float) -> FoundRange:
    return FoundRange(
        animation=take.animation,
        start=start,
        end=end,
        start_seconds=take.begin + start / take.frame_rate,
        end_seconds=take.begin + min(end, take.frames - 1) / take.frame_rate,
        distance=round(distance, 5),
    )
