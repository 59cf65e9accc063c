"""The service as a client sees it: what `caesura submit` and `caesura demo` say over HTTP."""

import time
from collections.abc import Iterator, Mapping
from typing import IO, Any

import httpx

from caesura.core.document import SegmentationDocument
from caesura.core.errors import CaesuraError
from caesura.core.progress import Progress, ignore_progress
from caesura.service.commands.problems import Unreachable

CHUNK_BYTES = 2**18
FIRST_WAIT_SECONDS = 2  # a short take is answered by the upload's own response
POLL_SECONDS = 0.5
CONNECT_SECONDS = 5.0
ANSWER_SECONDS = 60.0


class Refused(CaesuraError):
    """The service's own problem, as it said it."""

    def __init__(self, problem: Mapping[str, Any]) -> None:
        super().__init__(str(problem["code"]), str(problem["detail"]))
        self._problem = dict(problem)

    def problem(self) -> dict[str, Any]:
        """The problem document, unchanged."""
        return self._problem


class Client:
    """One service; an address without a scheme is http, as for curl. Close it, or use it as a context."""

    def __init__(self, url: str, key: str = "") -> None:
        self.url = (url if "://" in url else f"http://{url}").rstrip("/")
        self._http = httpx.Client(
            headers={"Authorization": f"Bearer {key}"} if key else {},
            base_url=self.url,
            timeout=httpx.Timeout(ANSWER_SECONDS, connect=CONNECT_SECONDS),
            trust_env=False,  # no proxy stands between this command and the service it is told
        )

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: object) -> None:
        self._http.close()

    def segment(
        self, file: IO[bytes], name: str, parameters: Mapping[str, str], progress: Progress = ignore_progress
    ) -> SegmentationDocument:
        """Upload the file, wait until it is cut, and fetch the result; raises `Refused` or `Unreachable`."""
        status = self._ask(
            "POST",
            "/v1/segmentations",
            params={**parameters, "name": name},
            content=_stream(file, progress),
            headers={"Content-Length": str(_size(file)), "Prefer": f"wait={FIRST_WAIT_SECONDS}"},
        )
        while status["status"] in {"queued", "running"}:
            progress(status["progress"]["stage"] or status["status"], status["progress"]["fraction"])
            time.sleep(POLL_SECONDS)
            status = self._ask("GET", f"/v1/segmentations/{status['id']}")
        if status["status"] != "done":
            raise Refused(status["problem"] or {"code": status["status"], "detail": f"It was {status['status']}."})
        result = self._ask("GET", f"/v1/segmentations/{status['id']}/result", headers={"Accept": "application/json"})
        return SegmentationDocument.model_validate(result)

    def _ask(self, method: str, path: str, **request: Any) -> dict[str, Any]:
        """The JSON of an answer."""
        try:
            response = self._http.request(method, path, **request)
        except httpx.TransportError as fault:
            raise Unreachable("unreachable", f"No answer from {self.url}: {fault or type(fault).__name__}.") from None
        try:
            answer = response.json()
        except ValueError:
            answer = None
        if response.is_error and isinstance(answer, dict) and {"code", "detail"} <= answer.keys():
            raise Refused(answer)
        if response.is_error or not isinstance(answer, dict):
            detail = f"{self.url} answered {response.status_code} to {method} {path}: this is no Caesura service."
            raise Unreachable("not-a-service", detail)
        return answer


def _size(file: IO[bytes]) -> int:
    return file.seek(0, 2)


def _stream(file: IO[bytes], progress: Progress) -> Iterator[bytes]:
    """The file by chunks, so that its size does not matter."""
    total = _size(file)
    file.seek(0)
    while chunk := file.read(CHUNK_BYTES):
        progress("uploading", file.tell() / total)
        yield chunk
