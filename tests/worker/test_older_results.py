"""What an earlier version stored is still read: fields that came later have their defaults."""

import json

from caesura.core.document import SegmentationDocument
from caesura.worker.records import redis_keys

RECORD = {
    "id": "old", "animation": "take", "parameters": {"motions": 2}, "algorithm": "0", "status": "done",
    "created": 1.0, "updated": 2.0,
}  # fmt: skip
DOCUMENT = {
    "id": "old", "algorithm": "0", "method": "switching", "parameters": {"motions": 2},
    "source": {"take": 0, "name": "take", "fps": 30.0}, "frames": 2, "frame_rate": 30.0, "duration_seconds": 1 / 30,
    "motions": 1, "key_frames": [], "energy": [None, 0.5],
    "segments": [{"start": 0, "end": 2, "start_seconds": 0.0, "end_seconds": 1 / 30, "motion": 0, "name": "A"}],
}  # fmt: skip
"""As the first version wrote them, before repeats, confidences, scores, warnings and revisions."""


def test_a_result_of_an_earlier_version_is_read(idle):
    """Record and document, by a version that knows more fields; the algorithm stays the one that made it."""
    idle.redis.set(redis_keys.segmentation_key("old"), json.dumps(RECORD))
    idle.redis.set(redis_keys.segmentation_key("old", "document"), json.dumps(DOCUMENT))
    record = idle.records.segmentations.one("old")
    assert (record.status, record.algorithm, record.revision) == ("done", "0", 0)
    assert record.chosen().motions == 2
    document = SegmentationDocument.model_validate_json(idle.records.segmentations.result("old")[0])
    assert document.segments[0].confidence == 1
    assert document.model_dump(mode="json", exclude_unset=True) == DOCUMENT


def test_what_a_later_version_adds_is_passed_over(idle):
    """While two versions run side by side, the older one reads the newer one's records."""
    idle.redis.set(redis_keys.segmentation_key("new"), json.dumps({**RECORD, "id": "new", "colour": "green"}))
    assert idle.records.segmentations.one("new").status == "done"
    assert SegmentationDocument.model_validate({**DOCUMENT, "mood": "glad"}).frames == 2
