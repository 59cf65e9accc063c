"""What happens inside can be seen from outside: metrics, logs, and one id from the request to the job."""

import json
import logging
import re
import time

import pytest
from prometheus_client.parser import text_string_to_metric_families

from caesura.service.uploads.capacity import FULL_SHARE
from caesura.worker import logs
from caesura.worker.records.connection import connect
from tests.service.conftest import serve


def scraped(service):
    """Every sample that a Prometheus would read, by its name and labels."""
    answer = service.http.get("/metrics")
    assert answer.headers["Content-Type"].startswith("text/plain; version=")
    families = list(text_string_to_metric_families(answer.text))
    names = [family.name for family in families]
    assert len(names) == len(set(names))
    assert all(family.documentation for family in families)
    return {(s.name, *sorted(s.labels.items())): s.value for family in families for s in family.samples}


def value(samples, name, **labels):
    return samples.get((name, *sorted(labels.items())), 0.0)


def test_a_job_is_seen_from_its_request_to_its_stages(service, take):
    """Counted once where it came into a state, and each of its stages with the seconds it took."""
    before = scraped(service)
    answer = service.http.post("/v1/segmentations", content=take(801), headers={"Prefer": "wait=30"})
    assert answer.json()["status"] == "done"
    while value(scraped(service), "caesura_stage_seconds_count", stage="strain") == value(
        before, "caesura_stage_seconds_count", stage="strain"
    ):
        time.sleep(0.05)  # told by the worker once its attempt is over
    after = scraped(service)

    def more(name, **labels):
        return value(after, name, **labels) - value(before, name, **labels)

    for status in ("queued", "running", "done"):
        assert more("caesura_segmentations_total", status=status, code="") >= 1, status
    assert more("caesura_stage_seconds_bucket", stage="strain", le="+Inf") >= 1
    assert more("caesura_stage_seconds_sum", stage="strain") > 0
    assert more("caesura_waited_seconds_count", queue="analyse") >= 1
    route = {"method": "POST", "route": "/v1/segmentations"}
    assert more("caesura_requests_total", status="200", **route) == 1
    assert more("caesura_request_seconds_count", **route) == 0  # it was asked to wait
    for gauge in ("redis_used_bytes", "disk_free_bytes"):
        assert value(after, f"caesura_{gauge}") > 0


def test_a_bad_file_is_counted_under_its_code(service):
    """So that a board shows what people stumble over."""
    body = b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "file:///etc/passwd", "byteLength": 4}]}'
    answer = service.http.post("/v1/segmentations", content=body, headers={"Prefer": "wait=20"})
    code = answer.json()["code"]
    counted = value(scraped(service), "caesura_segmentations_total", status="failed", code=code)
    assert counted >= 1 or answer.status_code in {400, 415, 422}  # refused at the door, or by the worker


def test_routes_have_names_and_strangers_have_none(idle):
    """However many ids and paths are asked for, the number of series does not grow."""
    idle.http.get("/v1/segmentations/one")
    idle.http.get("/nothing")
    scraped(idle)
    before = len(scraped(idle))
    for number in range(20):
        idle.http.get(f"/v1/segmentations/none{number}")
        idle.http.get(f"/nothing/{number}")
    samples = scraped(idle)
    assert len(samples) == before
    assert value(samples, "caesura_requests_total", method="GET", route="none", status="404") >= 21


@pytest.mark.parametrize(
    ("given", "kept"), [("trace-7f:1.2_x", True), ("a b", False), ("x" * 65, False), ("<script>", False), ("", False)]
)
def test_a_request_has_one_id(idle, given, kept):
    """The client's own where it is harmless, else a new one; in the answer whatever its status."""
    for path in ("/healthz", "/v1/segmentations/none"):
        answered = idle.http.get(path, headers={"X-Request-Id": given}).headers["X-Request-Id"]
        assert (answered == given) == kept
        assert re.fullmatch(r"[A-Za-z0-9._:-]{1,64}", answered)


def test_the_id_goes_into_the_record(idle, take):
    """So that the worker's lines can be found by the request's."""
    answer = idle.http.post("/v1/segmentations", content=take(802), headers={"X-Request-Id": "seen-again"})
    kept = connect(idle.redis_url).get(f"caesura:segmentation:{answer.json()['id']}")
    assert json.loads(kept)["request"] == "seen-again"


def test_lines_for_machines_are_json_and_lines_for_people_are_short():
    """Both say what they are about; a traceback stays in its line of JSON."""
    record = logging.LogRecord("here", logging.INFO, "file", 1, "it is %s", ("so",), None)
    record.told = {"status": 200}
    with logs.log_context(request="7", segmentation=""):
        told = json.loads(logs.JsonLines().format(record))
        assert logs.TextLines("%(levelname)s %(message)s").format(record) == "INFO it is so request=7 status=200"
        assert logs.request_id() == "7"
    assert {
        "message": "it is so",
        "request": "7",
        "status": 200,
        "level": "INFO",
        "logger": "here",
    }.items() <= told.items()
    assert logs.request_id() == ""
    record.exc_info = (RuntimeError, RuntimeError("twice\nas long"), None)
    line = logs.JsonLines().format(record)
    assert "\n" not in line
    assert "twice" in json.loads(line)["traceback"]


def test_no_value_forges_a_line_for_people():
    """Neither a value, nor a message, nor an exception's text starts a line, ends a value or reaches the terminal."""
    forged = "/a\n2026-01-01 INFO service.requests: request\x1b[2J status=200"
    record = logging.LogRecord("here", logging.INFO, "file", 1, "asked for %s", (forged,), None)
    record.told = {"path": forged, "empty": ""}
    record.exc_info = (ValueError, ValueError(forged), None)
    first, *rest = logs.TextLines("%(levelname)s %(message)s").format(record).split("\n")
    assert first == f"INFO asked for /a path={forged!r} empty="
    assert len(rest) == 3
    assert all(line.startswith("    ") for line in rest)
    assert not any("\x1b" in line for line in rest)


def test_a_path_forges_no_line(checkout, idle, tmp_path, capfd):
    """A newline and an escape character that are sent within a path are shown as what they are."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        other.http.get("/nothing%0A2026-01-01%20INFO%20forged%1B%5B2J")
    lines = capfd.readouterr().err.splitlines()
    assert any("path='/nothing\\n2026-01-01 INFO forged\\x1b[2J' status=404" in line for line in lines)
    assert not any(line.startswith("2026-01-01") or "\x1b" in line for line in lines)


def test_no_secret_is_logged(checkout, idle, tmp_path, capfd):
    """Neither a key, right or wrong, nor a cookie, a query or a body."""
    settings = {"access": "keys", "log_format": "json"}
    with serve(checkout, tmp_path, idle.redis_url, workers=False, **settings) as guarded:
        guarded.http.post("/v1/session", json={"key": "caesura_hidden"})
        headers = {"Authorization": "Bearer caesura_hidden", "Cookie": "caesura-session=hidden", "X-Request-Id": "told"}
        guarded.http.get("/v1/animations?name=hidden", headers=headers)
    lines = capfd.readouterr().err
    assert "hidden" not in lines
    told = [json.loads(line) for line in lines.splitlines() if '"request": "told"' in line]
    assert {"method": "GET", "path": "/v1/animations", "status": 401}.items() <= told[0].items()


def test_work_is_refused_before_redis_is_full(checkout, idle, take, tmp_path):
    """At four fifths of its memory: 503 with Retry-After, and not ready; what is there is still read."""
    client = connect(idle.redis_url)
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        kept = other.http.post("/v1/segmentations", content=take(803)).json()["id"]
        used = int(client.info("memory")["used_memory"])
        client.config_set("maxmemory", int(used / (FULL_SHARE + 0.1)))
        try:
            time.sleep(1.1)  # what was looked at is believed for a second
            refused = other.http.post("/v1/segmentations", content=take(804))
            assert (refused.status_code, refused.json()["code"]) == (503, "not-ready")
            assert int(refused.headers["Retry-After"]) >= 1
            assert "memory" in other.http.get("/readyz").json()["detail"]
            assert other.http.get(f"/v1/segmentations/{kept}").json()["status"] == "queued"
            assert not other.spooled()
        finally:
            client.config_set("maxmemory", 0)
        assert "memory" not in other.http.get("/readyz").json()["detail"]
