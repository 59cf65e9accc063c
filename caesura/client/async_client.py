"""A service, asked from asyncio."""

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any, Self

from caesura.client import exchange
from caesura.client.connection import TransportError, as_answer, connect_async, no_answer
from caesura.client.exchange import DEFAULT_URL, Answer, Call, Exchange, Pause, Wanted
from caesura.client.upload import Upload
from caesura.core.progress import Progress, ignore_progress
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import FileSources


class AsyncClient:
    """What `Client` is, for asyncio: every call is awaited.

        async with AsyncClient("localhost:8000") as client:
            found = await client.segment("take.glb", motions=5)

    Every call raises `ServiceProblem` with what the service says, or `Unreachable`. A service that is busy and says
    when it has time again is asked again then, a few times.
    """

    def __init__(self, url: str = DEFAULT_URL, key: str = "") -> None:
        self.url = exchange.base_url(url)
        self._http = connect_async(url, key)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Hang up."""
        await self._http.aclose()

    async def segment(
        self, source: FileSources, *, name: str = "", progress: Progress = ignore_progress, **parameters: Any
    ) -> SegmentationDocument:
        """Upload a file, wait until it is cut, and fetch the result.

        `source` is a path, an open file or bytes, or several that belong together, as `caesura.segment` takes them;
        `name` is what it is called there; `parameters` are those of `caesura.segment`.
        """
        return await self._run(exchange.segment(source, name, progress, parameters))

    async def submit(
        self, source: FileSources, *, name: str = "", progress: Progress = ignore_progress, **parameters: Any
    ) -> dict[str, Any]:
        """Upload a file and do not wait: the status document, whose `id` names the segmentation."""
        return await self._run(exchange.submit(source, name, progress, parameters))

    async def status(self, identifier: str) -> dict[str, Any]:
        """The status document: `status` is queued, running, done, failed or cancelled."""
        return await self._run(exchange.status_of(identifier))

    async def wait(self, identifier: str, *, progress: Progress = ignore_progress) -> dict[str, Any]:
        """The status document once it is done; raises `ServiceProblem` where it failed or was cancelled."""
        return await self._run(exchange.wait(await self.status(identifier), progress))

    async def result(self, identifier: str, *, revision: int | None = None) -> SegmentationDocument:
        """The result, of a revision where one is named; `Segmentation.of` makes arrays of it."""
        return await self._run(exchange.result(identifier, revision))

    async def download(self, identifier: str, what: str, path: str | Path | None = None, **query: Any) -> bytes:
        """A file of a result, such as "clips", "plot.png" or "result.npz", written to `path` where one is given."""
        content = await self._run(exchange.download(identifier, what, exchange.as_query(query)))
        if path is not None:
            await asyncio.to_thread(Path(path).write_bytes, content)
        return content

    async def delete(self, identifier: str) -> None:
        """Forget a segmentation, or cancel it."""
        await self._run(exchange.delete(identifier))

    async def _run(self, asked: Exchange[Wanted]) -> Wanted:
        answer: Answer | None = None
        while True:
            try:
                step = asked.send(answer)
            except StopIteration as done:
                wanted: Wanted = done.value
                return wanted
            if isinstance(step, Pause):
                await asyncio.sleep(step.seconds)
                answer = None
            else:
                answer = await self._ask(step)

    async def _ask(self, call: Call) -> Answer:
        body = _without_waiting(call.upload) if call.upload else None
        try:
            return as_answer(
                await self._http.request(call.method, call.path, params=call.query, headers=call.headers, content=body)
            )
        except TransportError as fault:
            raise no_answer(self.url, fault) from None


async def _without_waiting(upload: Upload) -> AsyncIterator[bytes]:
    """The body; a piece that is read from a disk holds nobody up for longer than itself."""
    for piece in upload.pieces():
        yield piece
