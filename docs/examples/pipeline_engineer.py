"""From a farm: post files to a running service, wait, and fetch documents and clips. Python's standard library alone.

    python docs/examples/pipeline_engineer.py http://localhost:8000 out/ takes/*.glb

The same file posted twice is computed once: its id is made of its content. So a job that was cut short is simply
run again. CAESURA_KEY is sent where the service asks for a key. The exit status is 1 where a file was refused.
"""

import json
import os
import sys
import time
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.parse import quote
from urllib.request import Request, urlopen

PATIENCE_SECONDS = 30  # a request waits so long at the service before it is asked again
KEY = os.environ.get("CAESURA_KEY")


def ask(method: str, url: str, body: Any = None, length: int = 0) -> tuple[int, bytes]:
    """Status and content of an answer; a busy service (429, 503) is asked again when it said."""
    headers = {"Prefer": f"wait={PATIENCE_SECONDS}", "Content-Length": str(length)}
    if KEY:
        headers["Authorization"] = f"Bearer {KEY}"
    while True:
        try:
            with urlopen(Request(url, body, headers, method=method), timeout=2 * PATIENCE_SECONDS) as answer:
                return answer.status, answer.read()
        except HTTPError as refused:
            if refused.code not in (429, 503):
                raise
            time.sleep(int(refused.headers.get("Retry-After", 5)))
            if body is not None:
                body.seek(0)


def segment(service: str, take: Path, motions: str = "auto") -> dict[str, Any]:
    """Upload, wait, and answer the status document once it is done; raises HTTPError with the problem."""
    with take.open("rb") as file:
        url = f"{service}/v1/segmentations?motions={motions}&name={quote(take.name)}"
        _, content = ask("POST", url, file, take.stat().st_size)
    status: dict[str, Any] = json.loads(content)
    while status["status"] in ("queued", "running"):
        status = json.loads(ask("GET", f"{service}/v1/segmentations/{status['id']}")[1])
    return status


def fetch(service: str, status: dict[str, Any], what: str) -> bytes:
    """One file of a result; one that is made at the first request answers 202 until it is there."""
    code = 202
    while code == 202:
        code, content = ask("GET", f"{service}/v1/segmentations/{status['id']}/{what}")
    return content


def main(service: str, out: Path, takes: list[Path]) -> int:
    """All files, one line each."""
    out.mkdir(parents=True, exist_ok=True)
    failed = 0
    for take in takes:
        try:
            status = segment(service, take)
            (out / f"{take.stem}.json").write_bytes(fetch(service, status, "result"))
            clips = fetch(service, status, "clips")  # a GLB of a glTF too; a zip of a vertex sequence
            (out / f"{take.stem}.clips{'.glb' if clips.startswith(b'glTF') else '.zip'}").write_bytes(clips)
            print(f"{take}: {status['motions']} motions in {len(status['segments'])} segments")
        except HTTPError as refused:
            failed = 1
            print(f"{take}: {json.loads(refused.read())['detail']}", file=sys.stderr)
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1].rstrip("/"), Path(sys.argv[2]), [Path(name) for name in sys.argv[3:]]))
