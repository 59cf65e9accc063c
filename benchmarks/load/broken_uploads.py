"""An upload that is cut at random, again and again: `python -m benchmarks.load.broken_uploads [--cuts 50]`.

Ends with status 1 where it cannot go on, where a try gets no further, or where the file that comes out is another.
"""

import argparse
import hashlib
import io
import random
import socket
import sys
import time

import httpx
import numpy as np

from benchmarks.load.measure import Measure, table
from benchmarks.timing.processes import service

SETTLE_SECONDS = 0.2


def main() -> None:
    """Cut, go on, compare."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--cuts", type=int, default=50)
    options.add_argument("--megabytes", type=int, default=200)
    options.add_argument("--seed", type=int, default=7)
    chosen = options.parse_args()
    content = vertex_sequence(chosen.megabytes)
    with service() as running:
        measures = measured(running.url, content, chosen.cuts, random.Random(chosen.seed))
    print(table(measures))
    sys.exit(0 if all(one.kept for one in measures) else 1)


def vertex_sequence(megabytes: int) -> bytes:
    """An NPZ of random vertices: no two blocks of it are alike."""
    frames = megabytes * 10**6 // (12 * 1000)
    out = io.BytesIO()
    vertices = np.random.default_rng(0).normal(size=(frames, 1000, 3)).astype("<f4")
    np.savez(out, vertices=vertices, triangles=[[0, 1, 2]], frame_rate=30.0)
    return out.getvalue()


def measured(url: str, content: bytes, cuts: int, chance: random.Random) -> list[Measure]:
    """Go on after each cut, and fetch what has become of it."""
    stuck = made = 0
    with httpx.Client(base_url=url, trust_env=False, timeout=120) as http:
        begun = http.post("/v1/uploads", headers={"Upload-Length": str(len(content))})
        address, start = begun.headers["Location"], 0
        while made < cuts:
            sent = chance.randrange(1, 2 * (len(content) - start) // (cuts - made + 1))
            _cut(url, address, content, start, sent)
            after = _settled(http, address)
            stuck += after <= start
            start, made = after, made + 1
        headers = {"Upload-Offset": str(start), "Content-Type": "application/offset+octet-stream"}
        last = http.patch(address, content=content[start:], headers=headers)
        file = http.get(last.headers.get("Content-Location", "/") + "/file")
    same = hashlib.sha256(file.content).digest() == hashlib.sha256(content).digest()
    return [
        Measure("bytes", len(content)),
        Measure("cuts", made, least=cuts),
        Measure("tries that got no further", stuck, most=0),
        Measure("files that came out byte for byte", int(same), least=1),
    ]


def _cut(url: str, address: str, content: bytes, start: int, sent: int) -> None:
    """Send so many bytes of the rest, and hang up."""
    place = httpx.URL(url)
    head = (
        f"PATCH {address} HTTP/1.1\r\nHost: localhost\r\nUpload-Offset: {start}\r\n"
        f"Content-Type: application/offset+octet-stream\r\nContent-Length: {len(content) - start}\r\n\r\n"
    )
    with socket.create_connection((place.host, place.port or 80)) as line:
        line.sendall(head.encode() + content[start : start + sent])


def _settled(http: httpx.Client, address: str) -> int:
    """The offset once the service has noticed that the line is broken."""
    before = -1
    while (now := int(http.head(address).headers["Upload-Offset"])) != before:
        before = now
        time.sleep(SETTLE_SECONDS)
    return now


if __name__ == "__main__":
    main()
