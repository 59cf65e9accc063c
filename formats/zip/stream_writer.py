"""A zip written as a stream: pieces of its members in, pieces of the zip out. The same members give the same bytes."""

import io
import zipfile
from collections.abc import Iterable, Iterator
from typing import BinaryIO, cast

EPOCH = (1980, 1, 1, 0, 0, 0)


class _Sink(io.RawIOBase):
    """Takes what is written until it is fetched; it cannot be wound back, so sizes follow what they are of."""

    def __init__(self) -> None:
        super().__init__()
        self._written: list[bytes] = []

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        self._written.append(bytes(cast("bytes", data)))
        return len(self._written[-1])

    def fetch(self) -> Iterator[bytes]:
        written, self._written = self._written, []
        yield from written


def stream_zip(members: Iterable[tuple[str, Iterable[bytes]]], *, deflated: bool) -> Iterator[bytes]:
    """A zip of the members, (name, pieces) each, drawn when their turn comes."""
    sink = _Sink()
    with zipfile.ZipFile(cast("BinaryIO", sink), "w") as archive:
        for name, pieces in members:
            info = zipfile.ZipInfo(name, EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED if deflated else zipfile.ZIP_STORED
            info.external_attr = 0o644 << 16
            with archive.open(info, "w", force_zip64=True) as member:
                for piece in pieces:
                    member.write(piece)
                    yield from sink.fetch()
            yield from sink.fetch()
    yield from sink.fetch()
