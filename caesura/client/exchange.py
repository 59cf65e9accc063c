"""What is asked of a service and what is made of its answers, without a connection: both clients drive these.

An exchange is a generator. It yields a `Call`, is sent the `Answer`, and returns what was wanted; it yields a `Pause`
where it would wait.
"""

from collections.abc import Generator, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

from caesura.client.errors import ServiceProblem, Unreachable
from caesura.client.upload import Upload
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import FileSources, open_parts

FIRST_WAIT_SECONDS = 2
"""A short take is answered by the upload's own response."""
POLL_SECONDS = 0.5
TRIES = 4
"""How often a service that says when it has time again is asked."""
LONGEST_PAUSE_SECONDS = 60.0
CONNECT_SECONDS = 5.0
ANSWER_SECONDS = 60.0
DEFAULT_URL = "http://127.0.0.1:8000"


@dataclass(frozen=True)
class Call:
    """One request."""

    method: str
    path: str
    query: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)
    upload: Upload | None = None


@dataclass(frozen=True)
class Pause:
    """Nothing is asked for so long."""

    seconds: float


@dataclass(frozen=True)
class Answer:
    """One response: `document` is its JSON where it is an object, else None."""

    status: int
    headers: Mapping[str, str]
    content: bytes
    document: dict[str, Any] | None


Wanted = TypeVar("Wanted")
Exchange = Generator[Call | Pause, Answer | None, Wanted]


def base_url(url: str) -> str:
    """The address of a service; without a scheme it is http, as for curl."""
    return (url if "://" in url else f"http://{url}").rstrip("/")


def as_query(given: Mapping[str, Any]) -> dict[str, str]:
    """Values as a query string spells them."""
    return {name: str(value).lower() if isinstance(value, bool) else str(value) for name, value in given.items()}


def segment(
    source: FileSources, name: str, progress: Progress, given: Mapping[str, Any]
) -> Exchange[SegmentationDocument]:
    """Upload, wait and fetch."""
    status = yield from submit(source, name, progress, given)
    status = yield from wait(status, progress)
    return (yield from result(status["id"]))


def submit(source: FileSources, name: str, progress: Progress, given: Mapping[str, Any]) -> Exchange[dict[str, Any]]:
    """Upload and have it segmented: the status document. Parameters are judged before a long upload."""
    Parameters.parse(given)
    parts = open_parts(source)
    name = name or next(iter(parts), "")
    query = as_query(given)
    upload = Upload(parts, progress)
    headers = {**upload.headers, "Prefer": f"wait={FIRST_WAIT_SECONDS}"}
    call = Call("POST", "/v1/segmentations", {**query, "name": name} if name else query, headers, upload)
    return (yield from _ask(call))


def wait(status: dict[str, Any], progress: Progress) -> Exchange[dict[str, Any]]:
    """The status document once it is done; raises `ServiceProblem` where it failed or was cancelled."""
    while status["status"] in {"queued", "running"}:
        progress(status["progress"]["stage"] or status["status"], status["progress"]["fraction"])
        yield Pause(POLL_SECONDS)
        status = yield from _ask(Call("GET", f"/v1/segmentations/{status['id']}"))
    if status["status"] != "done":
        raise ServiceProblem(status["problem"] or {"code": status["status"], "detail": f"It was {status['status']}."})
    return status


def status_of(identifier: str) -> Exchange[dict[str, Any]]:
    """The status document."""
    return (yield from _ask(Call("GET", f"/v1/segmentations/{identifier}")))


def result(identifier: str, revision: int | None = None) -> Exchange[SegmentationDocument]:
    """The result; of a revision where one is named."""
    query = {} if revision is None else {"revision": str(revision)}
    call = Call("GET", f"/v1/segmentations/{identifier}/result", query, {"Accept": "application/json"})
    return SegmentationDocument.model_validate((yield from _ask(call)))


def download(identifier: str, what: str, query: Mapping[str, str]) -> Exchange[bytes]:
    """A file of a result; one that is made at the first request is waited for."""
    while True:
        answer = yield from _answered(Call("GET", f"/v1/segmentations/{identifier}/{what}", query))
        if answer.status != 202:
            return answer.content
        yield Pause(_retry_after(answer) or POLL_SECONDS)


def delete(identifier: str) -> Exchange[None]:
    """Forget a segmentation, or cancel it."""
    yield from _answered(Call("DELETE", f"/v1/segmentations/{identifier}"))


def _ask(call: Call) -> Exchange[dict[str, Any]]:
    """The JSON of an answer."""
    answer = yield from _answered(call)
    if answer.document is None:
        raise _no_service(call, answer)
    return answer.document


def _answered(call: Call) -> Exchange[Answer]:
    """An answer that is no refusal; a busy service is asked again when it said."""
    for left in range(TRIES - 1, -1, -1):
        answer = yield from _send(call)
        pause = _retry_after(answer) if answer.status in {429, 503} else 0.0
        if not (pause and left):
            break
        yield Pause(pause)
    if answer.status < 400:
        return answer
    if answer.document is not None and {"code", "detail"} <= answer.document.keys():
        raise ServiceProblem(answer.document)
    raise _no_service(call, answer)


def _send(call: Call) -> Exchange[Answer]:
    answer = yield call
    if answer is None:
        raise TypeError("a call is sent its answer")
    return answer


def _no_service(call: Call, answer: Answer) -> Unreachable:
    detail = f"The server answered {answer.status} to {call.method} {call.path}: this is no Caesura service."
    return Unreachable("not-a-service", detail)


def _retry_after(answer: Answer) -> float:
    said = answer.headers.get("Retry-After", "")
    return min(float(said), LONGEST_PAUSE_SECONDS) if said.isdecimal() else 0.0
