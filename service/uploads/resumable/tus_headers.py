"""The headers of tus 1.0: its version, offsets, lengths and names."""

import base64
import binascii
import re
from email.utils import formatdate
from pathlib import Path

from fastapi import Request

from caesura.core.errors import ParameterError, UnsupportedMedia
from caesura.service.problems.problem_response import RequestProblem

VERSION = "1.0.0"
EXTENSIONS = "creation,expiration,termination"
CONTENT_TYPES = frozenset({"application/offset+octet-stream", "application/octet-stream"})
"""Of a piece: that of the protocol, and that which generated clients send."""

LONGEST_METADATA = 4096
_NUMBER = re.compile(r"\d{1,15}")


class WrongVersion(RequestProblem):
    """The client speaks another version of the protocol, or none."""

    headers = {"Tus-Version": VERSION, "Tus-Resumable": VERSION}  # noqa: RUF012  as every refusal has them


async def require_version(request: Request) -> None:
    """Raises `WrongVersion` where the client speaks another version."""
    if request.headers.get("tus-resumable", VERSION) != VERSION:
        raise WrongVersion("tus-version", f"Send Tus-Resumable: {VERSION}.")


def number_header(request: Request, name: str) -> int:
    """A header that is a number of bytes; raises `ParameterError` where it is not."""
    given = request.headers.get(name, "")
    if not _NUMBER.fullmatch(given):
        raise ParameterError("invalid-parameter", f"Send the header {name}: a number of bytes.", parameter=name)
    return int(given)


def check_content_type(request: Request) -> None:
    """Raises `UnsupportedMedia` where the body is not announced as a piece of a file."""
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() not in CONTENT_TYPES:
        detail = "Send a piece of the file as Content-Type: application/offset+octet-stream."
        raise UnsupportedMedia("unsupported-media-type", detail)


def metadata_name(header: str) -> str:
    """The file's name in an Upload-Metadata header: pairs with commas between, values in base64."""
    if len(header) > LONGEST_METADATA:
        raise ParameterError("invalid-parameter", "Upload-Metadata is too long.", parameter="Upload-Metadata")
    pairs = dict(pair.strip().partition(" ")[::2] for pair in header.split(","))
    try:
        return base64.b64decode(pairs.get("filename", "") or pairs.get("name", ""), validate=True).decode()
    except (ValueError, binascii.Error):
        detail = "The name in Upload-Metadata is no UTF-8 in base64."
        raise ParameterError("invalid-parameter", detail, parameter="Upload-Metadata") from None


def http_date(seconds: float) -> str:
    """A time in seconds since 1970 as headers have it."""
    return formatdate(seconds, usegmt=True)


def partial_folder(scratch: Path) -> Path:
    """Where pieces are kept: on the file system of the store, so that a whole file is moved into it."""
    return scratch / "resumable"
