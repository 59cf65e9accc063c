"""Heavy work for as long as something else is measured: the worker on `analyse` is never without a take."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count

from benchmarks.load.calls import Calls
from caesura.samples.session import long_session

FRAMES = 9_000
WAITING = 2
LOOK_SECONDS = 0.1
WINDOW_SECONDS = 1.3


@contextmanager
def busy(url: str) -> Iterator[None]:
    """Post one five-minute take with ever other windows, each of which is a new analysis, so that some always wait."""
    over = threading.Event()
    with Calls(url) as calls:
        uploaded = calls.http.post("/v1/animations", content=long_session(FRAMES).glb)
        animation = uploaded.raise_for_status().json()["id"]
        windows = (WINDOW_SECONDS + number / 1000 for number in count())
        running = [_posted(calls, animation, next(windows)) for _ in range(WAITING)]
        while calls.status(running[0])["status"] == "queued":
            over.wait(LOOK_SECONDS)
        feeder = threading.Thread(target=_feed, args=(url, animation, windows, running, over), daemon=True)
        feeder.start()
        try:
            yield
            if calls.status(running[0])["status"] != "running" and calls.status(running[1])["status"] == "queued":
                raise RuntimeError("the heavy worker had nothing to do")
        finally:
            over.set()
            feeder.join()
            calls.http.delete(f"/v1/animations/{animation}")


def _posted(calls: Calls, animation: str, window: float) -> str:
    identifier: str = calls.cut_again(animation, wait=False, motions=4, window_seconds=window)["id"]
    return identifier


def _feed(url: str, animation: str, windows: Iterator[float], running: list[str], over: threading.Event) -> None:
    with Calls(url) as calls:
        while not over.wait(LOOK_SECONDS):
            if calls.status(running[0])["status"] == "done":
                calls.delete(running.pop(0))
                running.append(_posted(calls, animation, next(windows)))
