"""The name of a file as it is shown and saved."""

from collections.abc import Sequence
from email.message import Message
from email.utils import collapse_rfc2231_value
from typing import Any

LONGEST_NAME = 200


def disposition_name(header: str) -> str:
    """The file's name of a Content-Disposition header (RFC 6266), `filename*` before `filename`; empty without any."""
    message = Message()
    message["content-disposition"] = header.encode("latin-1", "replace").decode("utf-8", "replace")
    given: Sequence[tuple[str, Any]] = message.get_params((), "content-disposition") or ()
    names = [value for name, value in given if name.lower() == "filename"]
    encoded = [value for value in names if isinstance(value, tuple)]  # how the library tells `filename*`
    return str(collapse_rfc2231_value([*encoded, *names, ""][0]))


def plain_name(path: str) -> str:
    """The last step of a path, without what does not print, such as marks of direction; empty where nothing is left."""
    last = path.replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable()).strip(" .")[:LONGEST_NAME]
