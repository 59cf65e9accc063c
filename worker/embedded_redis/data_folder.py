"""The folder of an embedded server: who may serve it, where it listens, and which server wrote what lies there.

One server at a time serves a folder: the lock is inherited by the server, so it lasts as long as that does.
"""

import fcntl
import logging
import os
import subprocess
import tempfile
import time
from pathlib import Path

import redis

from caesura.worker.private_folder import make_private

log = logging.getLogger(__name__)

TAKEOVER_SECONDS = 15.0
LONGEST_SOCKET = 100  # bytes; the system's limit is 104 to 108


class ServerUnavailable(RuntimeError):
    """There is no server program, its folder is in use, or it did not start; the message says what to do."""


class ServerFolder:
    """One folder, made where it is not there. `socket` is where its server listens."""

    def __init__(self, path: Path) -> None:
        make_private(path)
        self.path = path
        self.socket = _socket_path(path)
        self._lock: int | None = None

    def take(self) -> int:
        """Lock it, where it is not ours yet: the lock, for the server to inherit. Raises `ServerUnavailable`."""
        if self._lock is None:
            self._lock = self._locked()
        return self._lock

    def release(self) -> None:
        """Others may take it, once the server has ended too."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def written_by(self, program: str) -> Path:
        """Where the server of a program keeps its file; raises `ServerUnavailable` where a newer one wrote that.

        Valkey and Redis keep apart, for neither reads all of the other.
        """
        told = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout  # noqa: S603  ours or the keeper's
        product = "valkey" if "valkey" in told.lower() else "redis"
        major = int(told.split("v=")[1].split(".")[0])
        kept = self.path / product
        kept.mkdir(exist_ok=True)
        stamp = kept / "version"
        written = stamp.read_text() if stamp.exists() else ""
        if written and int(written) > major:
            raise ServerUnavailable(f"{kept} was written by version {written}; {program} is only {major}.")
        if written != str(major):  # what is there is not written again: the disk may be full
            stamp.write_text(str(major))
        return kept

    def _locked(self) -> int:
        """The lock of the folder. A server whose owner is gone is asked to end, and waited for."""
        lock = os.open(self.path / "lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        deadline = time.monotonic() + TAKEOVER_SECONDS
        asked = False
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                owner = int(os.pread(lock, 32, 0) or b"0")
                if _alive(owner) or time.monotonic() > deadline:
                    os.close(lock)
                    raise ServerUnavailable(
                        f"{self.path} is used by process {owner}: end that one, or choose another CAESURA_DATA_DIR."
                    ) from None
                asked = asked or self._ask_to_end()
                time.sleep(0.05)
            else:
                os.ftruncate(lock, 0)
                os.pwrite(lock, str(os.getpid()).encode(), 0)
                return lock

    def _ask_to_end(self) -> bool:
        """Where a parent's death is not told to its children (macOS), the server has outlived its owner."""
        try:
            with redis.Redis(unix_socket_path=str(self.socket)) as client:
                client.shutdown()
        except redis.RedisError:
            log.info("the server that was left behind is ending already")
        return True


def _socket_path(folder: Path) -> Path:
    path = folder.absolute() / "redis.sock"
    return (
        path if len(os.fsencode(path)) <= LONGEST_SOCKET else Path(tempfile.mkdtemp(prefix="caesura-")) / "redis.sock"
    )


def _alive(process: int) -> bool:
    if process <= 0:
        return False
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
