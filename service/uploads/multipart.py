"""multipart/form-data, parsed as it streams: files go to the spool, short fields are parameters.

The web framework's own form parser keeps every file until the last byte has come and counts nothing; this one holds
one block in memory.
"""

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from python_multipart.exceptions import FormParserError
from python_multipart.multipart import MultipartParser, parse_options_header

from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.spool import Part, SpoolFile

if TYPE_CHECKING:  # the parser defines it for type checkers alone
    from python_multipart.multipart import MultipartCallbacks

MAX_PARTS = 64
MAX_FIELD_BYTES = 4096

FILE_FIELD = "file"
"""A part of this name is a file, whether it has a filename or not."""

OVERHEAD_BYTES = MAX_PARTS * 64 * 1024
"""What boundaries and part headers may add to the files themselves: the parser allows less than this a part."""


def multipart_boundary(content_type: str) -> bytes | None:
    """The boundary, where the header announces a multipart form."""
    kind, options = parse_options_header(content_type)
    return options.get(b"boundary") if kind == b"multipart/form-data" else None


class MultipartBody:
    """Receives a form block by block. Blocking calls: run them on a thread."""

    def __init__(self, folder: Path, mark: bytes) -> None:
        self._folder = folder
        self._files: list[SpoolFile] = []
        self._fields: dict[str, bytearray] = {}
        self._target: SpoolFile | bytearray = bytearray()
        self._header = (bytearray(), bytearray())
        self._disposition = b""
        self._parts = 0
        self._ended = False
        try:
            self._parser = MultipartParser(mark, self._callbacks())
        except FormParserError as wrong:
            _malformed(wrong)

    def _callbacks(self) -> "MultipartCallbacks":
        return {
            "on_header_field": lambda data, start, end: self._header[0].extend(data[start:end]),
            "on_header_value": lambda data, start, end: self._header[1].extend(data[start:end]),
            "on_header_end": self._header_ends,
            "on_headers_finished": self._part_begins,
            "on_part_data": self._part_continues,
            "on_end": self._form_ends,
        }

    def feed(self, block: bytes) -> None:
        """The next bytes of the body."""
        try:
            self._parser.write(block)
        except FormParserError as wrong:
            _malformed(wrong)

    def finish(self) -> tuple[tuple[Part, ...], dict[str, str]]:
        """The files, and the fields beside them."""
        if not self._ended:
            _malformed("it ends before its last boundary")
        fields = {name: bytes(value).decode("utf-8", "replace") for name, value in self._fields.items()}
        return tuple(file.finish() for file in self._files), fields

    def discard(self) -> None:
        """Delete what was received."""
        for file in self._files:
            file.discard()

    def _header_ends(self) -> None:
        field, value = (bytes(text) for text in self._header)
        if field.lower() == b"content-disposition":
            self._disposition = value
        self._header = (bytearray(), bytearray())

    def _part_begins(self) -> None:
        self._parts += 1
        if self._parts > MAX_PARTS:
            raise RequestProblem("too-many-parts", f"The form has more than {MAX_PARTS} parts. Send fewer files.")
        _, options = parse_options_header(self._disposition)
        self._disposition = b""
        name = options.get(b"name", b"").decode("utf-8", "replace")
        if b"filename" in options or name == FILE_FIELD:
            file = SpoolFile(self._folder, options.get(b"filename", b"").decode("utf-8", "replace"))
            self._files.append(file)
            self._target = file
        else:
            self._target = self._fields[name] = bytearray()

    def _part_continues(self, data: bytes, start: int, end: int) -> None:
        piece = memoryview(data)[start:end]
        if isinstance(self._target, SpoolFile):
            self._target.write(piece)
            return
        self._target += piece
        if len(self._target) > MAX_FIELD_BYTES:
            raise RequestProblem(
                "field-too-long", "A form field is too long. A file needs a filename: curl -F file=@FILE."
            )

    def _form_ends(self) -> None:
        self._ended = True


def _malformed(why: object) -> NoReturn:
    raise RequestProblem(
        "malformed-multipart", f"The multipart form cannot be read: {why}. Send it again, whole."
    ) from None
