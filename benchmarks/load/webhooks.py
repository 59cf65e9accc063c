"""Webhooks of many jobs to a receiver that fails: `python -m benchmarks.load.webhooks [--jobs 200]`. Printed only.

The receiver fails every third call, and dies once for some seconds. The web process is killed once with SIGKILL. Ends
with status 1 where a call is missed or wrongly signed, where anything of it stays in Redis, or where the web process
has more threads afterwards than a quiet one has.
"""

import argparse
import os
import signal
import sys
import time
from collections import Counter

import httpx
from redis import Redis

from benchmarks.chaos.takes import takes
from benchmarks.load.measure import Measure, table
from benchmarks.timing.processes import PROC, Running, descendants, role, service
from benchmarks.timing.receiver import Receiver

DEAD_SECONDS = 5.0
PATIENCE_SECONDS = 900.0
SPARE_THREADS = 45
"""What a web process may have beside its loop: a pool of 40, and those of its libraries."""


def main() -> None:
    """Send, fail, wait, look."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--jobs", type=int, default=200)
    chosen = options.parse_args()
    os.environ["CAESURA_PRIVATE_NETWORKS"] = "127.0.0.1"
    with service() as running:
        measures = measured(running, takes(chosen.jobs))
    print(table(measures))
    sys.exit(0 if all(one.kept for one in measures) else 1)


def measured(running: Running, work: list[bytes]) -> list[Measure]:
    """All jobs, one after the other as fast as they are accepted, while the receiver and the web process fail."""
    began = time.monotonic()
    with httpx.Client(base_url=running.url, trust_env=False, timeout=60) as http:
        receiver = Receiver(http.get("/v1/callbacks/secret").json()["secret"])
        made: list[str] = []
        for number, take in enumerate(work):
            made.append(_submitted(http, take, receiver.url))
            if number == len(work) // 3:
                receiver.die()
            if number == len(work) // 2:
                time.sleep(DEAD_SECONDS)
                receiver.start()
                os.kill(_web(running), signal.SIGKILL)
        told = receiver.wait_for(made, PATIENCE_SECONDS)
        time.sleep(2)
        repeated = sum(count - 1 for count in Counter(call.document["data"]["id"] for call in receiver.calls).values())
        with Redis(unix_socket_path=str(running.redis)) as redis:
            left = sum(1 for kind in ("callbacks", "deliver") for _ in redis.scan_iter(f"caesura:{kind}*"))
        threads = len(list((PROC / str(_web(running)) / "task").iterdir()))
        receiver.die()
    return [
        Measure("segmentations with a webhook", len(set(made))),
        Measure("told of, each at least once", len(receiver.told() & set(made)), least=len(set(made))),
        Measure("told of by a repeated call", repeated),
        Measure("calls that the receiver refused", receiver.failed),
        Measure("calls with a wrong signature", sum(not call.signed for call in receiver.calls), most=0),
        Measure("keys of webhooks left in Redis", left, most=0),
        Measure("threads of the web process", threads, most=SPARE_THREADS),
        Measure("until all were told", time.monotonic() - began if told else PATIENCE_SECONDS, "s"),
    ]


def _submitted(http: httpx.Client, take: bytes, url: str) -> str:
    """The id; the same take is sent again where the connection breaks or the service is not ready."""
    while True:
        try:
            answer = http.post("/v1/segmentations", params={"callback_url": url}, content=take)
            if answer.status_code in {200, 202}:
                return str(answer.json()["id"])
        except httpx.TransportError:
            pass
        time.sleep(0.2)


def _web(running: Running) -> int:
    return next(pid for pid in descendants(running.pid) if role(pid) == "web")


if __name__ == "__main__":
    main()
