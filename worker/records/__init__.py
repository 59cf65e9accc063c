"""Reading and changing what Redis holds of ours, a file for each kind. A change of several keys is one MULTI.

animations     uploads, and when each was used last
analyses       what was computed of an upload, by the digest of what it was computed with
segmentations  what was asked of an upload, how far it is, and its result; every change is told on its channel
attempts       what the worker on a segmentation writes into it, as long as its attempt is the current one
exports        files made of a result
"""

import redis

from caesura.worker.records.analyses import Analyses
from caesura.worker.records.animations import Animations
from caesura.worker.records.attempts import Attempts
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
