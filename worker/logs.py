"""Log lines for people and for machines: one line an event, with the id of the request that it is about.

The id goes from the request to the job through the record, so that one search finds both. Nothing is logged that opens
anything: no key, no cookie, no query, no body.
"""

import json
import logging
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Literal

from caesura.worker.control_characters import escape_control_characters

Form = Literal["text", "json"]

TEXT = "%(asctime)s %(levelname)s %(name)s: %(message)s"

_CONTEXT: ContextVar[dict[str, str]] = ContextVar("about", default={})  # noqa: B039  never changed, only replaced
_REQUEST_ID = re.compile(r"[A-Za-z0-9._:-]{1,64}")


@contextmanager
def log_context(**ids: str) -> Iterator[None]:
    """What is logged in this block is about these: `request`, `segmentation`, …"""
    before = _CONTEXT.set({**_CONTEXT.get(), **{name: value for name, value in ids.items() if value}})
    try:
        yield
    finally:
        _CONTEXT.reset(before)


def request_id() -> str:
    """The id of the request that is being worked on; empty where there is none."""
    return _CONTEXT.get().get("request", "")


def safe_request_id(given: str) -> str:
    """An id that came from outside, where it is one; else a new one. It will stand in logs and headers."""
    return given if _REQUEST_ID.fullmatch(given) else secrets.token_hex(8)


def configure_logging(form: Form) -> None:
    """Everything to stderr, in this form."""
    handler = logging.StreamHandler()
    handler.setFormatter(JsonLines() if form == "json" else TextLines(TEXT))
    logging.basicConfig(level=logging.INFO, handlers=[handler], force=True)


class TextLines(logging.Formatter):
    """A line for people: `… message request=ID key=value`. What a client sent starts no line and ends no value."""

    def format(self, record: logging.LogRecord) -> str:
        """The line; further lines of the message and a traceback follow, each indented."""
        head, *rest = map(escape_control_characters, super().format(record).split("\n"))
        values = [f" {name}={_quote(str(value))}" for name, value in _values(record).items()]
        return "\n    ".join([head + "".join(values), *rest])


class JsonLines(logging.Formatter):
    """A line for machines: one JSON object, a traceback included."""

    def format(self, record: logging.LogRecord) -> str:
        """The line."""
        fields: dict[str, object] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname,
            "logger": record.name,
            "message": record.getMessage(),
            **_values(record),
        }
        if record.exc_info:
            fields["traceback"] = self.formatException(record.exc_info)
        return json.dumps(fields, ensure_ascii=False)


def _quote(value: str) -> str:
    """The value as it is where it is one word, else as Python writes text."""
    return value if value.isprintable() and not set(" =\"'") & set(value) else repr(value)


def _values(record: logging.LogRecord) -> dict[str, object]:
    """What the line is about, and what it was given beside its message: `log.info("…", extra={"fields": {…}})`."""
    fields: dict[str, object] = getattr(record, "fields", {})
    return {**_CONTEXT.get(), **fields}
