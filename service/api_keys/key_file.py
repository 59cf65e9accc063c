"""Keys from a mounted file, such as a secret of Kubernetes: a line `NAME OWNER DIGEST` for each, `metrics`
behind one that opens /metrics and nothing else, `#` for remarks.

The file is read again when it has changed, so that a key is added or revoked without a restart.
"""

import logging
import os
import re
from pathlib import Path

from caesura.service.api_keys.credentials import KeyRecord

log = logging.getLogger(__name__)

_LINE = re.compile(r"(\S+)\s+(\S+)\s+([0-9a-f]{64})(\s+metrics)?")


class KeyFile:
    """The keys of one file, by digest. A file that cannot be read holds none."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._seen: tuple[int, ...] | None = None  # no numbers: it could not be read
        self._keys: dict[str, KeyRecord] = {}

    def find(self, digest: str) -> KeyRecord | None:
        """The key with this digest, or None."""
        if self._path is None:
            return None
        try:
            found = os.stat(self._path)  # noqa: PTH116  two numbers, at every request
            seen = (found.st_mtime_ns, found.st_size, found.st_ino)
            if seen != self._seen:
                self._keys, self._seen = _read(self._path), seen
        except (OSError, UnicodeDecodeError) as fault:
            if self._seen != ():
                log.warning("The file of keys cannot be read, so none of its keys is known: %s", fault)
            self._keys, self._seen = {}, ()
        return self._keys.get(digest)


def key_file_line(record: KeyRecord) -> str:
    """A key as the file has it."""
    return f"{record.name} {record.owner} {record.digest}{' metrics' if record.metrics else ''}"


def _read(path: Path) -> dict[str, KeyRecord]:
    known = {}
    for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        said = text.partition("#")[0].strip()
        match = _LINE.fullmatch(said)
        if match:
            name, owner, digest, metrics = match.groups()
            known[digest] = KeyRecord(name=name, owner=owner, digest=digest, metrics=bool(metrics))
        elif said:
            log.error("%s, line %d is no key: NAME OWNER DIGEST is what `caesura keys add --line` prints", path, number)
    return known
