"""A service of one's own: `caesura serve` on a free port of this machine, for as long as Blender runs."""

import os
import re
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path

from .service_client import ServiceError
from .sliced_work import Cancelled

START_SECONDS = 180.0
"""A first start compiles for a minute."""

STOP_SECONDS = 15.0
LOOK_SECONDS = 0.1
ADDRESS = re.compile(r"^Caesura is at (\S+)$", re.MULTILINE)
LAST_WORDS = 300


def find_command(configured: str) -> str:
    """The program to start: the one that the preferences name, else `caesura` on the PATH."""
    found = shutil.which(configured.strip() or "caesura")
    if found is None:
        wanted = configured.strip() or "caesura"
        raise ServiceError(
            f"There is no command {wanted!r}. Install Caesura and name its command in the preferences of the add-on, "
            "or give the address of a service there."
        )
    return found


class LocalService:
    """The process, started at its first use."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._log: Path | None = None
        self._lock = threading.Lock()
        self.address = ""

    def start(self, configured: str, stop: threading.Event) -> str:
        """Its address, as soon as it answers; the one that runs already where one does."""
        with self._lock:
            if self._process is None or self._process.poll() is not None:
                self._open(find_command(configured))
            return self._announced(stop)

    def stop(self) -> None:
        """End it, if it runs."""
        process, self._process = self._process, None
        if process is not None:
            process.terminate()
            try:
                process.wait(STOP_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if self._log is not None:
            self._log.unlink(missing_ok=True)

    def _open(self, command: str) -> None:
        self.address = ""
        descriptor, name = tempfile.mkstemp(prefix="caesura-", suffix=".log")
        self._log = Path(name)
        # Blender's own Python must not reach into the command's.
        kept = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
        with os.fdopen(descriptor, "wb") as log:
            self._process = subprocess.Popen(
                [command, "serve", "--host", "127.0.0.1", "--port", "0"],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env=kept,
                start_new_session=os.name != "nt",
            )

    def _announced(self, stop: threading.Event) -> str:
        deadline = time.monotonic() + START_SECONDS
        while not self.address:
            process, log = self._process, self._log
            if stop.is_set() or process is None or log is None:
                raise Cancelled
            printed = log.read_text(errors="replace")
            if said := ADDRESS.search(printed):
                self.address = said[1]
            elif process.poll() is not None or time.monotonic() > deadline:
                raise ServiceError(f"The local service did not start. It said: {printed[-LAST_WORDS:].strip()}")
            else:
                time.sleep(LOOK_SECONDS)
        return self.address
