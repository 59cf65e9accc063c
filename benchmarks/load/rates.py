"""Reads a second, and how long one takes, of the service and of a bare FastAPI route, in turns."""

import json
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from urllib.parse import urlsplit

import httpx

from benchmarks.load.measure import Measure, percentile

CLIENTS = 4
TURNS = 5
SECONDS = 2.0
START_SECONDS = 20.0


@dataclass
class Reads:
    """Milliseconds of every read of one address, and the seconds in which they were made."""

    took: list[float] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def rate(self) -> float:
        """Reads a second, of all clients together."""
        return len(self.took) / self.seconds


def rates(url: str, identifier: str, seconds: float = SECONDS, turns: int = TURNS) -> list[Measure]:
    """Status, result and bare route, one after the other and again, each read by several processes at once."""
    here = f"/v1/segmentations/{identifier}"
    with bare_server() as bare:
        reads = {"bare": Reads(), "status": Reads(), "result": Reads()}
        addresses = {"bare": f"{bare}/bare/{identifier}", "status": url + here, "result": f"{url}{here}/result.json"}
        for _ in range(turns):
            for name, address in addresses.items():
                _read(address, seconds, reads[name])
    status, result, plain = reads["status"], reads["result"], reads["bare"]
    return [
        Measure("bare FastAPI route", plain.rate, "a second"),
        Measure("bare FastAPI route, p99", percentile(plain.took, 0.99), "ms"),
        Measure("status reads", status.rate, "a second"),
        Measure("status reads over the bare route", status.rate / plain.rate, least=0.25),
        Measure("status reads, p50", percentile(status.took, 0.5), "ms"),
        Measure("status reads, p99", percentile(status.took, 0.99), "ms", most=25),
        Measure("result reads", result.rate, "a second"),
        Measure("result reads, p50", percentile(result.took, 0.5), "ms"),
        Measure("result reads, p99", percentile(result.took, 0.99), "ms"),
    ]


def _read(address: str, seconds: float, reads: Reads) -> None:
    place = urlsplit(address)
    command = [
        sys.executable,
        "-m",
        "benchmarks.load.reader",
        str(place.hostname),
        str(place.port),
        place.path,
        str(seconds),
    ]
    clients = [subprocess.Popen(command, stdout=subprocess.PIPE) for _ in range(CLIENTS)]
    for client in clients:
        told, _ = client.communicate()
        if client.returncode:
            raise RuntimeError(f"a client of {address} failed")
        reads.took += json.loads(told)
    reads.seconds += seconds


@contextmanager
def bare_server() -> Iterator[str]:
    """A process with the bare route; its address."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        number = listening.fileno()
        command = [sys.executable, "-m", "benchmarks.load.bare", "--socket", str(number)]
        process = subprocess.Popen(command, pass_fds=(number,))
        url = f"http://127.0.0.1:{listening.getsockname()[1]}"
        try:
            _until_answered(url)
            yield url
        finally:
            process.terminate()
            process.wait()


def _until_answered(url: str) -> None:
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        try:
            httpx.get(f"{url}/bare/x", trust_env=False).raise_for_status()
        except httpx.TransportError:
            time.sleep(0.05)
        else:
            return
    raise TimeoutError(f"{url} does not answer")
