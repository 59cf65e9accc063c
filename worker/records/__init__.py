"""Records in Redis, a file for each kind. A change of several keys is one MULTI.

record_types    the records as frozen values
redis_keys      the keys of the records
animations      uploads, and when each was last used
analyses        analyses of an upload, by the digest of their parameters
segmentations   segmentations, their state and result; every change is published on their channel
attempts        changes that the current attempt of a worker makes
result_files    files made of a result
revisions       revisions of a result
callbacks       webhooks: addresses that wait, and calls that are to be made
collection_types  collections, their takes, motions and proposals as frozen values
collections     collections, changed in one MULTI each
async_collections  the same, read without blocking
async_records   the same records, read without blocking
subscription    messages of Redis channels
counters        what the workers count, for the metrics
content_ids     ids made of content
connection      the connection to Redis, and full disks
storage_version the version of all that is stored
"""

import redis

from caesura.worker.records.analyses import Analyses
from caesura.worker.records.animations import Animations
from caesura.worker.records.attempts import Attempts
from caesura.worker.records.collections import Collections
from caesura.worker.records.result_files import ResultFiles
from caesura.worker.records.segmentations import Segmentations


class Records:
    """The records of one Redis, for workers and thread pools."""

    def __init__(self, client: redis.Redis) -> None:
        self.redis = client
        self.animations = Animations(client)
        self.analyses = Analyses(client)
        self.segmentations = Segmentations(client)
        self.attempts = Attempts(client, self.segmentations)
        self.exports = ResultFiles(client)
        self.collections = Collections(client)

    def rename_animation(self, identifier: str, name: str) -> None:
        """Call an animation otherwise, and its segmentations that were called as it was."""
        before = self.animations.rename(identifier, name)
        if before is None or before.name == name:
            return
        for segmentation in self.segmentations.of(identifier):
            if segmentation.name == before.name:
                self.segmentations.change(segmentation.id, lambda kept: kept.with_changes(name=name))
