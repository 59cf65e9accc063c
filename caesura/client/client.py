"""A service, asked one after the other."""

import time
from pathlib import Path
from typing import Any, Self

from caesura.client import exchange
from caesura.client.connection import TransportError, as_answer, connect, no_answer
from caesura.client.exchange import DEFAULT_URL, Answer, Call, Exchange, Pause, Wanted
from caesura.core.progress import Progress, ignore_progress
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import FileSources


class Client:
    """One service; an address without a scheme is http, as for curl. Close it, or use it as a context.

        with Client("localhost:8000") as client:
            found = client.segment("take.glb", motions=5)
            client.download(found.id, "clips", "clips.glb")

    Every call raises `ServiceProblem` with what the service says, or `Unreachable`. A service that is busy and says
    when it has time again is asked again then, a few times.
    """

    def __init__(self, url: str = DEFAULT_URL, key: str = "") -> None:
        self.url = exchange.base_url(url)
        self._http = connect(url, key)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Hang up."""
        self._http.close()

    def segment(
        self, source: FileSources, *, name: str = "", progress: Progress = ignore_progress, **parameters: Any
    ) -> SegmentationDocument:
        """Upload a file, wait until it is cut, and fetch the result.

        `source` is a path, an open file or bytes, or several that belong together, as `caesura.segment` takes them;
        `name` is what it is called there; `parameters` are those of `caesura.segment`.
        """
        return self._run(exchange.segment(source, name, progress, parameters))

    def submit(
        self, source: FileSources, *, name: str = "", progress: Progress = ignore_progress, **parameters: Any
    ) -> dict[str, Any]:
        """Upload a file and do not wait: the status document, whose `id` names the segmentation."""
        return self._run(exchange.submit(source, name, progress, parameters))

    def status(self, identifier: str) -> dict[str, Any]:
        """The status document: `status` is queued, running, done, failed or cancelled."""
        return self._run(exchange.status_of(identifier))

    def wait(self, identifier: str, *, progress: Progress = ignore_progress) -> dict[str, Any]:
        """The status document once it is done; raises `ServiceProblem` where it failed or was cancelled."""
        return self._run(exchange.wait(self.status(identifier), progress))

    def result(self, identifier: str, *, revision: int | None = None) -> SegmentationDocument:
        """The result, of a revision where one is named; `Segmentation.of` makes arrays of it."""
        return self._run(exchange.result(identifier, revision))

    def download(self, identifier: str, what: str, path: str | Path | None = None, **query: Any) -> bytes:
        """A file of a result, such as "clips", "plot.png" or "result.npz", written to `path` where one is given."""
        content = self._run(exchange.download(identifier, what, exchange.as_query(query)))
        if path is not None:
            Path(path).write_bytes(content)
        return content

    def delete(self, identifier: str) -> None:
        """Forget a segmentation, or cancel it."""
        self._run(exchange.delete(identifier))

    def _run(self, asked: Exchange[Wanted]) -> Wanted:
        answer: Answer | None = None
        while True:
            try:
                step = asked.send(answer)
            except StopIteration as done:
                wanted: Wanted = done.value
                return wanted
            if isinstance(step, Pause):
                time.sleep(step.seconds)
                answer = None
            else:
                answer = self._ask(step)

    def _ask(self, call: Call) -> Answer:
        body = call.upload.pieces() if call.upload else None
        try:
            return as_answer(
                self._http.request(call.method, call.path, params=call.query, headers=call.headers, content=body)
            )
        except TransportError as fault:
            raise no_answer(self.url, fault) from None
