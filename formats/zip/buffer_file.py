"""A buffer as a file, without a copy of it."""

import io


class BufferFile(io.RawIOBase):
    """Reads and seeks in a memoryview: what the zip reader wants of a file that is already mapped."""

    def __init__(self, data: memoryview) -> None:
        self._data = data
        self._at = 0

    def readable(self) -> bool:
        """Always."""
        return True

    def seekable(self) -> bool:
        """Always."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Move to `offset` from the start, from here, or from the end."""
        origin = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: len(self._data)}[whence]
        if origin + offset < 0:
            raise OSError("before the beginning")
        self._at = origin + offset
        return self._at

    def readinto(self, buffer: object) -> int:
        """Copy what fits of what is left."""
        target = memoryview(buffer).cast("B")  # type: ignore[arg-type]  # typeshed's buffer protocol
        piece = self._data[self._at : self._at + len(target)]
        target[: len(piece)] = piece
        self._at += len(piece)
        return len(piece)
