"""What is done to the service, again and again until it is over; each attack got through once."""

import base64
import contextlib
import io
import os
import socket
import threading
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count, islice
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx

from benchmarks.load.calls import Calls
from benchmarks.load.takes import different, put_together, taken_apart
from caesura.samples.sample_figures import build_figure

MEGABYTE = 2**20
LISTED, TAKES, NAME = 100, 1000, 1000
"""Files of a list, takes of each, letters of each take's name."""
EXTRAS = 24_000_000
DOWNLOADS = 300
PAUSE_SECONDS = 0.5


@dataclass
class Target:
    """The service, its data folder, and what was uploaded before the attack: ids of a segmentation, an animation."""

    url: str
    data: Path
    segmentation: str = ""
    animation: str = ""
    over: threading.Event = field(default_factory=threading.Event)
    http: httpx.Client = field(default_factory=lambda: httpx.Client(timeout=120, trust_env=False))

    def post(self, content: bytes | Iterator[bytes], path: str = "/v1/animations", **headers: str) -> int:
        """The status of the answer; 0 where there is none."""
        return self.ask("POST", path, content=content, headers=headers)

    def ask(self, method: str, path: str, **request: Any) -> int:
        """The same of any call."""
        try:
            return self.http.request(method, self.url + path, **request).status_code
        except httpx.TransportError:
            return 0


Attack = Callable[[Target, "Counter[int]"], None]


def prepare(target: Target) -> None:
    """Upload what lists, exports and downloads are of."""
    document, rest = taken_apart(build_figure("smooth").glb)
    (one, *_) = document["animations"]
    short = {"samplers": one["samplers"][:1], "channels": [{**one["channels"][0], "sampler": 0}]}
    names = (f"take {number} ".ljust(NAME, "x") for number in range(TAKES))
    listed = put_together({**document, "animations": [{"name": name, **short} for name in names]}, rest)
    for glb in islice(different(listed), LISTED):
        target.post(glb)
    document["asset"]["extras"] = {"random": base64.b64encode(os.urandom(EXTRAS)).decode()}
    with Calls(target.url) as calls:
        status = calls.post_file(put_together(document, rest))
    target.segmentation, target.animation = status["id"], status["animation"]


def name_of_digits(target: Target, answers: Counter[int]) -> None:
    """Zips of 120 kB whose member has a name of 60,000 digits."""
    while not target.over.wait(PAUSE_SECONDS):
        answers[target.post(_zip({"1" * 60_000 + ".obj": b"v 0 0 0\n"}))] += 1


def endless_sign_in(target: Target, answers: Counter[int]) -> None:
    """Keys of 400 MB."""
    while not target.over.wait(PAUSE_SECONDS):
        body = (bytes(MEGABYTE) for _ in range(400))
        answers[target.post(body, "/v1/session", **{"Content-Type": "application/json"})] += 1


def long_lists(target: Target, answers: Counter[int]) -> None:
    """Lists of files with many takes."""
    while not target.over.wait(0):
        answers[target.ask("GET", f"/v1/animations?limit={LISTED}")] += 1


def many_exports(target: Target, answers: Counter[int]) -> None:
    """A file for each segment, each with all extras, in ever other forms."""
    for number in count():
        if target.over.wait(PAUSE_SECONDS):
            return
        query = f"files=separate&handles_seconds={number % 60}"
        answers[target.ask("GET", f"/v1/segmentations/{target.segmentation}/clips?{query}")] += 1


def slow_shapes(target: Target, answers: Counter[int]) -> None:
    """An OBJ of `usemtl` lines, and one of a polygon with thousands of corners."""
    for number in count():
        if target.over.wait(PAUSE_SECONDS):
            return
        lines = "".join(f"usemtl {n}\nf 1 2 3\n" for n in range(5000))
        polygon = "f " + " ".join(str(1 + n % 3) for n in range(4000)) + "\n"
        shape = (f"v 0 0 {number}\nv 1 0 0\nv 0 1 0\n" + (polygon if number % 2 else lines)).encode()
        answers[target.post(_zip({"a1.obj": shape, "a2.obj": shape}), "/v1/segmentations")] += 1


def unread_downloads(target: Target, answers: Counter[int]) -> None:
    """Clients that ask for a large file and read nothing of it, fifty more each second."""
    place = urlsplit(target.url)
    asked = f"GET /v1/animations/{target.animation}/file HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
    with contextlib.ExitStack() as stack:
        for _ in range(DOWNLOADS):
            client = stack.enter_context(socket.create_connection((str(place.hostname), place.port or 80)))
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            client.sendall(asked)
            answers[200] += 1
            target.over.wait(0.02)
        target.over.wait()


def fill(target: Target, answers: Counter[int]) -> None:
    """The disk is filled to the last byte, things are deleted and exported meanwhile, and it is emptied again."""
    filler = target.data / "filler"
    spare = build_figure("rigid").glb
    while not target.over.wait(PAUSE_SECONDS):
        with contextlib.suppress(OSError), filler.open("wb", buffering=0) as file:
            while True:
                file.write(bytes(MEGABYTE))
        answers[target.post(spare, "/v1/segmentations?motions=3")] += 1
        answers[target.ask("GET", f"/v1/segmentations/{target.segmentation}/result.npz")] += 1
        answers[target.ask("DELETE", f"/v1/segmentations/{'a' * 26}")] += 1
        target.over.wait(5)
        filler.unlink(missing_ok=True)


ATTACKS: dict[str, Attack] = {
    "a name of 60,000 digits in a zip": name_of_digits,
    "keys of 400 MB": endless_sign_in,
    "lists of a hundred files with a thousand takes": long_lists,
    "exports of a file with 24 MB of extras": many_exports,
    "slow OBJ files": slow_shapes,
    "downloads that read nothing": unread_downloads,
}


def _zip(members: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return out.getvalue()
