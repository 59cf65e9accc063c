"""The records, queue and store that routes use, opened once for each process."""

import math
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Annotated

from anyio import CancelScope, move_on_after, to_thread
from fastapi import Depends, Request
from redis.exceptions import RedisError

from caesura.service.api_keys.key_file import KeyFile
from caesura.service.http.outgoing.address_policy import AddressPolicy
from caesura.service.http.outgoing.allowed_hosts import AllowedHosts
from caesura.service.http.stream_limit import StreamLimit
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.settings import ServiceSettings
from caesura.worker.private_folder import make_private
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import content_ids
from caesura.worker.records.async_records import AsyncRecords
from caesura.worker.records.connection import connect
from caesura.worker.records.record_types import AnimationRecord, SegmentationRecord
from caesura.worker.records.storage_version import check_layout
from caesura.worker.store.blobs import Blobs
from caesura.worker.store.temporary_files import delete_abandoned_files


@dataclass
class Backend:
    """`records` reads without blocking; `jobs` and `blobs` block, so they are called on threads."""

    settings: ServiceSettings
    records: AsyncRecords
    jobs: Jobs
    blobs: Blobs
    key_file: KeyFile
    stream_limit: StreamLimit = field(default_factory=StreamLimit)
    address_policy: AddressPolicy = field(default_factory=AddressPolicy)
    upload_hosts: AllowedHosts = field(default_factory=lambda: AllowedHosts(""))
    fetches: int = 0
    """Uploads by URL that are under way."""
    _waits: set[CancelScope] = field(default_factory=set)

    @cached_property
    def secret(self) -> bytes:
        """The key of all ids. Blocks at first use: Redis need not be up when the process starts."""
        return content_ids.installation_secret(self.jobs.redis, self.settings.secret)

    @property
    def spool(self) -> Path:
        """Where uploads are received: on the store's file system where that is a folder."""
        return self.settings.scratch_dir / "spool"

    async def animation(self, identifier: str, owner: str) -> AnimationRecord:
        """The animation, or the refusal to say whether it exists."""
        record = await self.records.owned_animation(identifier, owner)
        if record is None:
            raise RequestProblem("not-found", f"There is no animation {identifier}. It may have been deleted.")
        return record

    async def segmentation(self, identifier: str, owner: str) -> SegmentationRecord:
        """The segmentation, or the refusal to say whether it exists."""
        record = await self.records.owned_segmentation(identifier, owner)
        if record is None:
            raise RequestProblem("not-found", f"There is no segmentation {identifier}. It may have been deleted.")
        return record

    @contextmanager
    def limited_wait(self, seconds: float = math.inf) -> Iterator[CancelScope]:
        """A wait of at most `seconds`; ended before where the process is told to stop."""
        with move_on_after(seconds) as scope:
            self._waits.add(scope)
            try:
                yield scope
            finally:
                self._waits.discard(scope)

    def stop_waiting(self) -> None:
        """End every wait now."""
        for scope in self._waits:
            scope.cancel()

    async def wait_until_settled(self, record: SegmentationRecord, seconds: float | None) -> SegmentationRecord:
        """The record once it is no longer live, or as it is after `seconds`."""
        if not seconds or not record.live:
            return record
        ended: SegmentationRecord | None = None
        with self.limited_wait(seconds):
            ended = await self.records.wait_until_ended(record.id)
        return ended or await self.segmentation(record.id, record.owner)

    async def position(self, record: SegmentationRecord) -> int | None:
        """How many jobs come before it; None where it does not wait."""
        if record.status != "queued":
            return None
        found = await self.records.redis.lpos(self.jobs.queues.key(record.queue), record.token)
        return found if isinstance(found, int) else None


@asynccontextmanager
async def open_backend(settings: ServiceSettings) -> AsyncIterator[Backend]:
    """The backend, until the process ends."""
    records = AsyncRecords(settings.redis_location)
    client = connect(settings.redis_location)
    jobs = Jobs(client, settings.attempts, settings.job_seconds, settings.max_queued)
    try:
        make_private(settings.data_dir)
        blobs = Blobs.open(settings.store_location, settings.scratch_dir)
        backend = Backend(
            settings,
            records,
            jobs,
            blobs,
            KeyFile(settings.keys_file),
            address_policy=AddressPolicy(settings.private_networks),
            upload_hosts=AllowedHosts(settings.upload_hosts),
        )
        with suppress(RedisError):  # it need not be up yet; the workers look too
            await to_thread.run_sync(check_layout, client)
        await to_thread.run_sync(
            delete_abandoned_files, backend.spool
        )  # of a process that was killed; what another one writes is held
        yield backend
    finally:
        await records.close()
        client.close()


async def backend_of(request: Request) -> Backend:
    """The process's backend. It waits for nothing, but FastAPI would call a plain function on a thread."""
    backend: Backend = request.app.state.backend
    return backend


BackendDependency = Annotated[Backend, Depends(backend_of)]
