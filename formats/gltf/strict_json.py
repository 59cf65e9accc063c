"""JSON as RFC 8259 has it, which is less than Python's reader takes. Light: no NumPy."""

import codecs
import json
from collections import Counter
from typing import Any, NoReturn

from caesura.core.errors import BrokenContainer


def parse_json_object(text: bytes | memoryview) -> dict[str, Any]:
    """The JSON object in UTF-8 `text`; a byte order mark is allowed.

    Raises `BrokenContainer("malformed-json")` for anything else: other encodings, NaN and Infinity, a name that
    occurs twice in one object, integers of thousands of digits, nesting deeper than the interpreter goes.
    """
    raw = bytes(text)
    try:
        decoded = raw.removeprefix(codecs.BOM_UTF8).decode("utf-8")
        value = json.loads(decoded, object_pairs_hook=_unique, parse_constant=_no_number)
    except UnicodeDecodeError as wrong:
        raise _malformed(f"is not UTF-8 at byte {wrong.start}") from None
    except json.JSONDecodeError as wrong:
        raise _malformed(f"breaks off at line {wrong.lineno}, column {wrong.colno}: {wrong.msg}") from None
    except RecursionError:
        raise _malformed("is nested too deeply") from None
    except ValueError as wrong:
        raise _malformed(str(wrong)[:200]) from None
    if not isinstance(value, dict):
        raise _malformed("must be an object at its root")
    return value


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        twice, _ = Counter(name for name, _ in pairs).most_common(1)[0]
        raise ValueError(f"names {twice[:80]!r} twice in one object")
    return table


def _no_number(literal: str) -> NoReturn:
    raise ValueError(f"holds {literal}, which is no JSON number")


def _malformed(what: str) -> BrokenContainer:
    return BrokenContainer("malformed-json", f"The JSON {what}. Export the file again.")
