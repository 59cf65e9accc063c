"""How far an attempt is, told beside it: its work does not wait for Redis, and what nobody could read is not told."""

import threading
from collections.abc import Callable

REPORT_SECONDS = 0.2

WriteProgress = Callable[[str, float], bool]
"""Writes a stage and its fraction; whether anybody still wants to know."""


class ProgressReporter:
    """A thread that writes the newest word, the first at once and then at most five times a second.

    Nothing is lost by that: a stage that is over before its word was due has a later one to take its place. `stop` it.
    """

    def __init__(self, write: WriteProgress) -> None:
        self._write = write
        self._word: tuple[str, float] | None = None
        self._said = threading.Condition()
        self._over = False
        self._wanted = True
        self._fault: BaseException | None = None
        self._thread = threading.Thread(target=self._tell, name="teller", daemon=True)
        self._thread.start()

    def say(self, stage: str, fraction: float) -> bool:
        """Have it told, and answer whether the words so far were wanted. Raises what writing one has raised."""
        with self._said:
            if self._fault is not None:
                raise self._fault
            self._word = (stage, fraction)
            self._said.notify()
            return self._wanted

    def stop(self) -> None:
        """No more words; one that is being written still is."""
        with self._said:
            self._over = True
            self._said.notify()
        self._thread.join()

    def _tell(self) -> None:
        while word := self._next():
            try:
                wanted = self._write(*word)
            except BaseException as fault:  # noqa: BLE001  it is raised where the next word is said
                self._fault = fault
                return
            if not wanted:
                self._wanted = False
                return
            with self._said:
                self._said.wait_for(lambda: self._over, REPORT_SECONDS)

    def _next(self) -> tuple[str, float] | None:
        """The newest word that was not told; None once there will be none."""
        with self._said:
            self._said.wait_for(lambda: self._over or self._word is not None)
            word, self._word = self._word, None
            return None if self._over else word
