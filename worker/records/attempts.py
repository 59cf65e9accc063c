"""What the worker on a segmentation writes into its record, as long as the token it holds is the record's.

A token that is no longer the record's writes nothing: the attempt is late, and another one, or none, is wanted now.
"""

from typing import Any

import redis
from redis.client import Pipeline

from caesura.worker.records import redis_keys
from caesura.worker.records.schema import SegmentationRecord
from caesura.worker.records.segmentations import Change, Segmentations

LEASE_SECONDS = 20  # an attempt whose worker gave no sign for so long is lost


class Attempts:
    """The attempts that run: begun by their token, kept by a lease, ended once."""

    def __init__(self, client: redis.Redis, segmentations: Segmentations) -> None:
        self._redis = client
        self._segmentations = segmentations

    def begin(self, identifier: str, token: str) -> SegmentationRecord | None:
        """queued -> running; None where this attempt is no longer wanted, or has begun before."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            wanted = record.token == token and record.status == "queued"
            return record.with_(status="running", stage="", fraction=0.0) if wanted else None

        return self._segmentations.change(identifier, change, lambda pipe, _: self.renew(token, pipe))

    def renew(self, token: str, client: redis.Redis | None = None) -> None:
        """Say that the attempt's worker lives."""
        (client or self._redis).set(redis_keys.lease_key(token), b"1", ex=LEASE_SECONDS)

    def leased(self, token: str) -> bool:
        """Whether its worker said so lately. A longer lease than any was given while Redis's clock was ahead."""
        return 0 <= self._redis.ttl(redis_keys.lease_key(token)) <= LEASE_SECONDS

    def change(self, identifier: str, token: str, **changes: Any) -> SegmentationRecord | None:
        """Change a running segmentation's fields where `token` is still its attempt; None where it is not."""
        return self._segmentations.change(identifier, lambda r: r.with_(**changes) if _running(r, token) else None)

    def finish(self, identifier: str, token: str, document: str, arrays: dict[str, bytes], **summary: Any) -> bool:
        """running -> done, with the result document and the byte arrays `energy` and `labels`, all at once."""

        def also(pipe: Pipeline, _: SegmentationRecord) -> None:
            pipe.set(redis_keys.segmentation_key(identifier, "document"), document)
            pipe.set(redis_keys.segmentation_key(identifier, "energy"), arrays["energy"])
            pipe.set(redis_keys.segmentation_key(identifier, "labels"), arrays["labels"])

        done = {"status": "done", "stage": "", "fraction": 1.0, "problem": None, **summary}
        change: Change = lambda r: r.with_(**done) if _running(r, token) else None  # noqa: E731  one line says it
        return self._segmentations.change(identifier, change, also) is not None

    def fail(self, identifier: str, token: str, problem: dict[str, Any]) -> bool:
        """running -> failed, with the problem that is answered from now on."""
        return self.change(identifier, token, status="failed", problem=problem) is not None


def _running(record: SegmentationRecord, token: str) -> bool:
    return record.token == token and record.status == "running"
