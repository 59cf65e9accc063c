"""The calls of the service's API, by the standard library alone. Each blocks: call it in a thread."""

import http.client
import json
import ssl
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import quote, urlencode, urlsplit

from .sliced_work import Cancelled

ANSWER_SECONDS = 60.0
WAIT_SECONDS = 2
"""How long the service may wait with its answer for a job to end; what cancels is seen that late."""

PIECE = 2**18
LOOPBACK = {"localhost", "127.0.0.1", "::1"}

Progress = Callable[[str, float], None]


class ServiceError(Exception):
    """The service's own words of what is wrong, or that there is none at the address."""

    def __init__(self, detail: str, code: str = "") -> None:
        super().__init__(detail)
        self.code = code


class ServiceClient:
    """One service; an address without a scheme is http. Redirections are not followed: the key goes nowhere else."""

    def __init__(self, address: str, key: str = "", stop: threading.Event | None = None) -> None:
        self.address = (address if "://" in address else f"http://{address}").rstrip("/")
        self._parts = urlsplit(self.address)
        if self._parts.scheme not in {"http", "https"} or not self._parts.hostname:
            raise ServiceError(f"{address!r} is no address of a service. One looks like http://localhost:8000.")
        self._key = key.strip()
        self._stop = stop or threading.Event()

    @property
    def is_local(self) -> bool:
        """Whether it runs on this machine, so that nothing goes through a network."""
        return self._parts.hostname in LOOPBACK

    def limits(self) -> dict[str, Any]:
        """How large an upload and a model may be."""
        return self._ask("GET", "/v1/limits")

    def upload(self, path: Path, name: str, progress: Progress) -> str:
        """Send a file; the id of its animation."""
        with path.open("rb") as file:
            size = path.stat().st_size
            answer = self._ask(
                "POST",
                f"/v1/animations?{urlencode({'name': name})}",
                self._pieces(file, size, progress),
                {"Content-Length": str(size), "Content-Type": "application/octet-stream"},
            )
        return str(answer["id"])

    def segment(self, animation: str, parameters: Mapping[str, Any], progress: Progress) -> dict[str, Any]:
        """Have the motions found, and wait; the segmentation document, of the newest revision where there is one."""
        status = self._ask_json("POST", "/v1/segmentations", {"animation": animation, **parameters})
        here = f"/v1/segmentations/{quote(status['id'])}"
        while status["status"] in {"queued", "running"}:
            if self._stop.is_set():
                self._ask("DELETE", here)
                raise Cancelled
            doing = status["progress"]
            progress(doing["stage"] or status["status"], doing["fraction"] or 0.0)
            status = self._ask("GET", here, headers={"Prefer": f"wait={WAIT_SECONDS}"})
        if status["status"] != "done":
            problem = status["problem"] or {"detail": f"The segmentation was {status['status']}.", "code": ""}
            raise ServiceError(problem["detail"], problem["code"])
        return self._ask("GET", f"{here}/result.json?revision=latest")

    def save_revision(
        self, segmentation: str, newest: int, segments: Sequence[Mapping[str, Any]], note: str
    ) -> dict[str, Any]:
        """Save the segments that a person has edited, on top of revision `newest`."""
        return self._ask_json(
            "POST",
            f"/v1/segmentations/{quote(segmentation)}/revisions",
            {"note": note, "segments": list(segments)},
            {"If-Match": f'"{newest}"'},
        )

    def _pieces(self, file: BinaryIO, size: int, progress: Progress) -> Iterator[bytes]:
        while piece := file.read(PIECE):
            if self._stop.is_set():
                raise Cancelled
            progress("sending", file.tell() / max(size, 1))
            yield piece

    def _ask_json(
        self, method: str, path: str, body: Mapping[str, Any], headers: Mapping[str, str] | None = None
    ) -> dict[str, Any]:
        return self._ask(
            method, path, json.dumps(body).encode(), {"Content-Type": "application/json", **(headers or {})}
        )

    def _ask(
        self, method: str, path: str, body: Any = None, headers: Mapping[str, str] | None = None
    ) -> dict[str, Any]:
        """The JSON of an answer; raises `ServiceError`."""
        key = {"Authorization": f"Bearer {self._key}"} if self._key else {}
        connection = self._connection()
        try:
            self._send(connection, method, self._parts.path + path, body, {**(headers or {}), **key})
            response = connection.getresponse()
            status, data = response.status, response.read()
        except (OSError, http.client.HTTPException) as fault:
            raise ServiceError(f"No answer from {self.address}: {fault or type(fault).__name__}.") from None
        finally:
            connection.close()
        return self._answer(status, data)

    @staticmethod
    def _send(
        connection: http.client.HTTPConnection, method: str, path: str, body: Any, headers: Mapping[str, str]
    ) -> None:
        try:
            connection.request(method, path, body=body, headers=dict(headers))
        except (BrokenPipeError, ConnectionResetError):
            return  # a refusal may come before the whole body has gone; it is read next

    def _answer(self, status: int, data: bytes) -> dict[str, Any]:
        try:
            answer = json.loads(data) if data else {}
        except ValueError:
            answer = None
        if status >= 400 and isinstance(answer, dict) and {"code", "detail"} <= answer.keys():
            raise ServiceError(str(answer["detail"]), str(answer["code"]))
        if status >= 300 or not isinstance(answer, dict):
            raise ServiceError(f"{self.address} answered {status}: this is no Caesura service.")
        return answer

    def _connection(self) -> http.client.HTTPConnection:
        host, port = self._parts.hostname or "", self._parts.port
        if self._parts.scheme == "https":
            context = ssl.create_default_context()
            return http.client.HTTPSConnection(host, port, timeout=ANSWER_SECONDS, context=context)
        return http.client.HTTPConnection(host, port, timeout=ANSWER_SECONDS)
