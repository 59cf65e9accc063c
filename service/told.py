"""What is told of a segmentation, worked out once for each state of its record, for many ask again and again.

A record is its stored bytes, so the same bytes are the same state, whoever wrote them.
"""

from dataclasses import dataclass
from functools import lru_cache

from service.documents import StatusDocument
from worker.schema import SegmentationRecord

STATES = 64
"""Of so many segmentations the last state is remembered; one of a long take takes some hundred kB."""


@dataclass(frozen=True)
class Told:
    """A record, and its status document as JSON; without its place in the queue, which is not in the record."""

    record: SegmentationRecord
    text: str


@lru_cache(maxsize=STATES)
def told(stored: bytes) -> Told:
    """What the stored bytes tell."""
    record = SegmentationRecord.model_validate_json(stored)
    return Told(record, StatusDocument.of(record).model_dump_json())
