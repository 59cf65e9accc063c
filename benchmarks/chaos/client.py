"""One of the clients of the chaos run: sends its takes, waits for each, and tries again as the API's page says.

A connection that breaks, 503 and 507 mean: try again. What was accepted (200 or 202) must be there ever after.
"""

import hashlib
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import httpx

TRY_AGAIN = {503, 507}
PAUSE_SECONDS = 0.2


@dataclass
class Seen:
    """What one client saw, by the number of the take: the result and its tag, the digest of its clips; what was lost,

    and how it went.
    """

    results: dict[int, tuple[str, str, bytes]] = field(default_factory=dict)
    clips: dict[int, str] = field(default_factory=dict)
    lost: list[str] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)
    tally: Counter[str] = field(default_factory=Counter)


def run(url: str, takes: list[tuple[int, bytes]], deadline: float, callback: str) -> Seen:
    """Send all, then fetch all; ends at `deadline` (of time.monotonic) with what there is.

    The service is asked to call `callback` for each.
    """
    seen = Seen()
    with httpx.Client(base_url=url, trust_env=False, timeout=10) as http:
        client = _Client(http, seen, deadline, callback)
        accepted = [(number, take, client.submit(take)) for number, take in takes]
        for number, take, identifier in accepted:
            client.fetch(number, take, identifier)
    return seen


class _Client:
    def __init__(self, http: httpx.Client, seen: Seen, deadline: float, callback: str) -> None:
        self._address = f"/v1/segmentations?callback_url={callback}"
        self._http = http
        self._seen = seen
        self._deadline = deadline

    def submit(self, take: bytes) -> str:
        """The id of the segmentation that was accepted; empty where time ran out."""
        for answer in self._answers("POST", self._address, content=take):
            if answer.status_code in {200, 202}:
                return str(answer.json()["id"])
            if answer.status_code not in TRY_AGAIN:
                self._seen.wrong.append(f"POST: {answer.status_code} {answer.text[:200]}")
                return ""
        return ""

    def fetch(self, number: int, take: bytes, identifier: str) -> None:
        """Wait until it is done, and keep the result; failed by the machine's fault: post it again, as it says."""
        if not identifier:
            return
        path = f"/v1/segmentations/{identifier}"
        for answer in self._answers("GET", path, headers={"Prefer": "wait=2"}):
            if answer.status_code == httpx.codes.NOT_FOUND:
                self._seen.lost.append(identifier)
                return
            status = answer.json().get("status")
            if status == "failed":
                self._seen.tally["posted again after the last attempt"] += 1
                if self.submit(take) != identifier:
                    self._seen.wrong.append(f"{identifier}: posted again it is another")
            elif status == "done" and self._keep(number, identifier):
                self._keep_clips(number, identifier)
                return
            elif answer.status_code not in {200, *TRY_AGAIN}:
                self._seen.wrong.append(f"GET: {answer.status_code} {answer.text[:200]}")
                return

    def _keep(self, number: int, identifier: str) -> bool:
        for answer in self._answers("GET", f"/v1/segmentations/{identifier}/result.json"):
            if answer.status_code == httpx.codes.OK:
                self._seen.results[number] = (identifier, answer.headers["ETag"], answer.content)
                return True
            if answer.status_code not in TRY_AGAIN:
                self._seen.wrong.append(f"result: {answer.status_code} {answer.text[:200]}")
                return False
        return False

    def _keep_clips(self, number: int, identifier: str) -> None:
        """A worker makes them when they are asked for."""
        path = f"/v1/segmentations/{identifier}/clips"
        for answer in self._answers("GET", path, headers={"Prefer": "wait=2"}):
            if answer.status_code == httpx.codes.OK:
                self._seen.clips[number] = hashlib.sha256(answer.content).hexdigest()
                return
            if answer.status_code not in {202, *TRY_AGAIN}:
                self._seen.wrong.append(f"clips: {answer.status_code} {answer.text[:200]}")
                return

    def _answers(self, method: str, path: str, **request: Any) -> Iterator[httpx.Response]:
        """Answers to the same request, one after the other, until time runs out; broken connections are counted."""
        while time.monotonic() < self._deadline:
            try:
                answer = self._http.request(method, path, **request)
            except httpx.TransportError:
                self._seen.tally["connections broken"] += 1
            else:
                if answer.status_code in TRY_AGAIN:
                    self._seen.tally["told to try again (503, 507)"] += 1
                yield answer
                if answer.status_code not in TRY_AGAIN:
                    continue
            time.sleep(PAUSE_SECONDS)
