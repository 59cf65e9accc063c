"""No call reads more of a body than it can use, with a key or without."""

from pathlib import Path

import httpx
import pytest

from caesura.service.app import create_app
from caesura.service.settings import ServiceSettings

PATHS = create_app(ServiceSettings(data_dir=Path("never-made"))).openapi()["paths"]
CALLS = [f"{method.upper()} {path}" for path, operations in PATHS.items() for method in operations]
MEGABYTE = bytes(2**20)
JSON = {"Content-Type": "application/json"}


def sent(idle, call, headers):
    """The answer to a body of 40 MB, sent piece by piece; None where the connection ends first."""
    method, path = call.replace("{identifier}", "a" * 26).split()
    try:
        return idle.http.request(method, path, content=(MEGABYTE for _ in range(40)), headers=JSON | headers)
    except httpx.TransportError:
        return None


@pytest.mark.parametrize("call", [call for call in CALLS if call != "POST /v1/animations"])
def test_a_body_of_any_size_takes_no_memory(idle, call):
    """Every call that is not an upload, also those that read no body: the web process stays as small as it was."""
    before = idle.status("VmHWM")
    sent(idle, call, {})
    assert idle.status("VmHWM") - before < 12_000_000


@pytest.mark.parametrize("headers", [{}, {"Content-Length": str(40 * 2**20)}], ids=["unannounced", "announced"])
@pytest.mark.parametrize("call", ["POST /v1/session", "POST /v1/segmentations"])
def test_json_that_is_too_long_is_refused(idle, call, headers):
    """One problem for all calls, announced or not."""
    answer = sent(idle, call, headers)
    assert answer is not None
    assert (answer.status_code, answer.json()["code"]) == (400, "json-too-long")
    assert answer.json()["limit"] < answer.json()["actual"] <= 40 * 2**20
