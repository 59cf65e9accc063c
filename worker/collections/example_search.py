"""Search by example: ranges of the takes of a collection that are like a range of an animation, bent in time."""

from caesura.core.together.example_search import IndexedTake, cut_example, index_take
from caesura.core.together.pose_space import PoseSpace
from caesura.worker.collections.collection_index import INDEX_CACHE
from caesura.worker.collections.take_files import measure
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
    kept = INDEX_CACHE.index(here, record)
    inside = next((one for one in kept.examples.takes if one.name == search.animation), None)
    example = inside or _measured_example(here, search, kept.examples.space)
    asked = cut_example(example, search.start, search.end or example.frames)
    threads = here.settings.threads or available_threads()
    ranges = kept.examples.find(asked, search.limit + 1, threads=threads)
    own = (search.animation, search.start, search.end or example.frames)
    others = [one for one in ranges if not _overlaps((one.take, one.start, one.end), own)]
    return tuple(_found(kept.takes[one.take], one.start, one.end, one.distance) for one in others[: search.limit])


def _measured_example(here: WorkerContext, search: SearchRecord, space: PoseSpace) -> IndexedTake:
    """An animation that is not in the collection, as it is searched."""
    segmentation = here.jobs.records.segmentations.one(search.segmentation)
    if segmentation is None or segmentation.status != "done":
        raise BlobMissing(search.animation)
    quota = JobQuota(here.settings.job_memory_bytes, here.settings.job_seconds)
    measured, _ = measure(here, quota, segmentation)
    return index_take(space, measured.name, measured.poses)


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
