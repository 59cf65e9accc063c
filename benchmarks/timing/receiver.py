"""A receiver of webhooks that fails every third call, and can die and come back on its port."""

import base64
import hashlib
import hmac
import json
import threading
import time
from email.message import Message
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, NamedTuple

PATIENCE_SECONDS = 0.1


class Call(NamedTuple):
    """A call that was answered with success: its id, what it said, and whether its signature was right."""

    id: str
    document: dict[str, Any]
    signed: bool


class _Server(ThreadingHTTPServer):
    allow_reuse_address = True
    daemon_threads = True


class Receiver:
    """Listens from the start; `calls` are those that it answered with success, `failed` counts the others."""

    def __init__(self, secret: str) -> None:
        self.calls: list[Call] = []
        self.failed = 0
        self._key = base64.b64decode(secret.removeprefix("whsec_"))
        self._count = 0
        self._lock = threading.Lock()
        self._port = 0
        self.start()

    @property
    def url(self) -> str:
        """Where it is called."""
        return f"http://127.0.0.1:{self._port}/hook"

    def start(self) -> None:
        """Listen, on the same port again after it has died."""
        receiver = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                self.send_response(204 if receiver.take(self.headers, body) else 500)
                self.end_headers()

            def log_message(self, format: str, *args: Any) -> None:  # noqa: A002  as the library has it
                """Say nothing."""

        self._server = _Server(("127.0.0.1", self._port), Handler)
        self._port = self._server.server_address[1]
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.05,), daemon=True)
        self._thread.start()

    def die(self) -> None:
        """Stop listening."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def take(self, headers: Message, body: bytes) -> bool:
        """Note a call; every third fails."""
        identifier, seconds = headers["webhook-id"], headers["webhook-timestamp"]
        digest = hmac.new(self._key, f"{identifier}.{seconds}.".encode() + body, hashlib.sha256).digest()
        right = str(headers["webhook-signature"]) == "v1," + base64.b64encode(digest).decode()
        with self._lock:
            self._count += 1
            if self._count % 3 == 0:
                self.failed += 1
                return False
            self.calls.append(Call(identifier, json.loads(body), right))
            return True

    def told(self) -> set[str]:
        """The segmentations that it was told of."""
        return {str(call.document["data"]["id"]) for call in self.calls}

    def wait_for(self, segmentations: list[str], seconds: float) -> bool:
        """Whether it was told of each of these within so many seconds."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if set(segmentations) <= self.told():
                return True
            time.sleep(PATIENCE_SECONDS)
        return False
