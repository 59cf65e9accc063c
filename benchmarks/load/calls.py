"""What a client asks of the service: post, wait, read."""

from collections.abc import Mapping
from typing import Any

import httpx

WAIT = {"Prefer": "wait=30"}
JSON = {"Content-Type": "application/json"}
ENDED = {"done", "failed", "cancelled"}


class Calls:
    """One client with one connection. Close it, or use it as a context."""

    def __init__(self, url: str) -> None:
        self.http = httpx.Client(base_url=url, timeout=120, trust_env=False)

    def __enter__(self) -> "Calls":
        return self

    def __exit__(self, *_: object) -> None:
        self.http.close()

    def post_file(self, glb: bytes, wait: bool = True, **parameters: Any) -> dict[str, Any]:
        """Post a take as the body; its status, once it has ended where that is waited for."""
        headers = WAIT if wait else {}
        return self._waited(
            self._status("POST", "/v1/segmentations", params=parameters, content=glb, headers=headers), wait
        )

    def cut_again(self, animation: str, wait: bool = True, **parameters: Any) -> dict[str, Any]:
        """Ask for another cut of what was uploaded."""
        asked = {"animation": animation, **parameters}
        headers = {**JSON, **(WAIT if wait else {})}
        return self._waited(self._status("POST", "/v1/segmentations", json=asked, headers=headers), wait)

    def status(self, identifier: str) -> dict[str, Any]:
        """How far it is."""
        return self._status("GET", f"/v1/segmentations/{identifier}")

    def ended(self, identifier: str) -> dict[str, Any]:
        """Its status once it has ended."""
        return self._waited(self.status(identifier), wait=True)

    def delete(self, identifier: str) -> None:
        """Cancel or delete a segmentation."""
        self.http.delete(f"/v1/segmentations/{identifier}")

    def _waited(self, status: dict[str, Any], wait: bool) -> dict[str, Any]:
        while wait and status["status"] not in ENDED:
            status = self._status("GET", f"/v1/segmentations/{status['id']}", headers=WAIT)
        if status["status"] == "failed":
            raise RuntimeError(f"a take failed: {status['problem']}")
        return status

    def _status(
        self, method: str, path: str, headers: Mapping[str, str] | None = None, **request: Any
    ) -> dict[str, Any]:
        response = self.http.request(method, path, headers=headers, **request)
        response.raise_for_status()
        status: dict[str, Any] = response.json()
        return status
