"""Records of what was computed from the vertices, by upload and digest of the heavy parameters (`ids.heavy_digest`)."""

import redis

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import names
from caesura.worker.records.schema import AnalysisRecord


class Analyses:
    """The analyses of one Redis."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def one(self, animation: str, digest: str) -> AnalysisRecord | None:
        """The analysis of an animation with certain heavy parameters, or None."""
        return AnalysisRecord.read(self._redis.get(redis_keys.analysis_key(animation, digest)))

    def all(self, animation: str) -> dict[str, AnalysisRecord]:
        """All analyses of an animation, by digest."""
        digests = sorted(names(self._redis.smembers(redis_keys.analyses_key(animation))))
        found = {digest: self.one(animation, digest) for digest in digests}
        return {digest: record for digest, record in found.items() if record is not None}

    def add(self, animation: str, digest: str, record: AnalysisRecord) -> AnalysisRecord | None:
        """Keep an analysis, and answer the one that is kept: this, or another that was there before.

        None where the animation was deleted meanwhile: then nothing is kept.
        """
        key = redis_keys.analysis_key(animation, digest)
        with self._redis.pipeline() as pipe:
            while True:
                pipe.watch(redis_keys.animation_key(animation))
                if not pipe.exists(redis_keys.animation_key(animation)):
                    return None
                pipe.multi()
                pipe.set(key, record.model_dump_json(), nx=True)
                pipe.sadd(redis_keys.analyses_key(animation), digest)
                pipe.get(key)
                try:
                    return AnalysisRecord.model_validate_json(pipe.execute()[-1])
                except redis.WatchError:
                    continue

    def delete(self, animation: str, digest: str) -> None:
        """Forget an analysis; its blobs are the caller's to delete."""
        with self._redis.pipeline() as pipe:
            pipe.delete(redis_keys.analysis_key(animation, digest))
            pipe.srem(redis_keys.analyses_key(animation), digest)
            pipe.execute()
