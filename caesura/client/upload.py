"""The body of an upload: one file as it is, several as a form; piece by piece, so that the size does not matter."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from secrets import token_hex
from urllib.parse import quote

from caesura.core.progress import Progress, ignore_progress

PIECE_BYTES = 2**18


@dataclass(frozen=True)
class Upload:
    """Files by name, to be sent as often as it takes."""

    parts: Mapping[str, memoryview]
    progress: Progress = ignore_progress
    boundary: str = field(default_factory=lambda: token_hex(16))

    @property
    def headers(self) -> dict[str, str]:
        """What is said of the body before it."""
        length = sum(len(piece) for piece in self._sections())
        headers = {"Content-Length": str(length)}
        if len(self.parts) > 1:
            headers["Content-Type"] = f"multipart/form-data; boundary={self.boundary}"
        return headers

    def pieces(self) -> Iterator[bytes]:
        """The body; reports how much of it has gone."""
        total = sum(len(section) for section in self._sections()) or 1
        sent = 0
        for section in self._sections():
            for start in range(0, len(section), PIECE_BYTES):
                piece = bytes(section[start : start + PIECE_BYTES])
                yield piece
                sent += len(piece)
                self.progress("uploading", sent / total)

    def _sections(self) -> Iterator[memoryview]:
        if len(self.parts) == 1:
            yield from (part.cast("B") for part in self.parts.values())
            return
        for name, part in self.parts.items():
            head = f'--{self.boundary}\r\nContent-Disposition: form-data; name="file"; filename="{quote(name)}"\r\n\r\n'
            yield memoryview(head.encode())
            yield part.cast("B")
            yield memoryview(b"\r\n")
        yield memoryview(f"--{self.boundary}--\r\n".encode())
