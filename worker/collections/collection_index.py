"""What is searched of a collection: read once, and kept by the process for the searches that follow.

Several workers each keep their own. The version of a collection counts its changes, so what is kept is used as it is
for the same version only; for another, the takes are listed anew, and those that were not there before are read.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from caesura.core.errors import InvalidModel
from caesura.core.together.example_search import ExampleIndex, IndexedTake
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import read_searched
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.store.blobs import BlobMissing, Blobs

MOST_KEPT_BYTES = 96 * 2**20
"""Of what is searched: 20 hours of takes have 86 MB. A larger index is read at every search."""
READERS = 8
"""Blobs that are read at once: a store that is far away takes its time for each."""


@dataclass(frozen=True)
class CollectionIndex:
    """The takes of a collection that are searched, in one version of it. `takes`: by animation, without segments.
    `read`: what is searched of each, by blob."""

    collection: str
    version: int
    space: str
    takes: Mapping[str, TakeRecord]
    read: Mapping[str, IndexedTake]
    examples: ExampleIndex


class IndexCache:
    """The index of the collection that was searched last."""

    def __init__(self) -> None:
        self._last: CollectionIndex | None = None

    def index(self, here: WorkerContext, record: CollectionRecord) -> CollectionIndex:
        """The index of a collection as it is now.

        Raises `InvalidModel` ("nothing-to-search") where no take can be searched, and `BlobMissing` where the
        collection is being deleted.
        """
        last = self._last if self._last is not None and self._last.collection == record.id else None
        if last is None or last.version != record.version:
            self._last = None  # its memory is free for what is read
            last = _read_index(here, record, last)
            if sum(one.values.nbytes for one in last.read.values()) <= MOST_KEPT_BYTES:
                self._last = last
        return last


INDEX_CACHE = IndexCache()
"""That of this process."""


def _read_index(here: WorkerContext, record: CollectionRecord, before: CollectionIndex | None) -> CollectionIndex:
    """All in one pose space: it may be learned anew while takes are listed."""
    collections = here.jobs.records.collections
    while True:
        takes = {take.animation: take.model_copy(update={"segments": ()}) for take in collections.all_takes(record.id)}
        now = collections.one(record.id)
        if now is None or now.space == record.space:
            break
        record = now
    keys = {name: key for name, take in sorted(takes.items()) if (key := _searched_key(take)) is not None}
    known = {} if before is None else {key: before.read[key] for key in keys.values() if key in before.read}
    missing = {name: key for name, key in keys.items() if key not in known}
    with ThreadPoolExecutor(READERS) as pool:
        fresh = zip(missing.values(), pool.map(lambda name: _read(here.blobs, takes[name]), missing), strict=True)
        read = known | {key: one for key, one in fresh if one is not None}
    if not record.space or not read:
        raise InvalidModel("nothing-to-search", "No take of the collection is labelled and still kept with its file.")
    if before is not None and before.space == record.space:
        space = before.examples.space
    else:
        space = StoredSpace.from_bytes(here.blobs.read(record.space)).space
    examples = ExampleIndex(space, tuple(read[key] for key in keys.values() if key in read))
    return CollectionIndex(record.id, record.version, record.space, takes, read, examples)


def _searched_key(take: TakeRecord) -> str | None:
    return take.numbers.searched if take.status == "labelled" and take.numbers is not None else None


def _read(blobs: Blobs, take: TakeRecord) -> IndexedTake | None:
    try:
        return read_searched(blobs, take)
    except BlobMissing:
        return None
