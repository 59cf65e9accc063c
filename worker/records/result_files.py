"""Records of files made of a result, by segmentation and form."""

import redis

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import names
from caesura.worker.records.schema import ExportRecord


class ResultFiles:
    """The files made of the results of one Redis."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def one(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return ExportRecord.read(self._redis.get(redis_keys.export_key(segmentation, form)))

    def forms(self, segmentation: str) -> list[str]:
        """The forms that were asked for."""
        return sorted(names(self._redis.smembers(redis_keys.exports_key(segmentation))))

    def write(self, segmentation: str, form: str, record: ExportRecord) -> bool:
        """Keep where the file is, or why there is none; False where the segmentation was deleted meanwhile."""
        key = redis_keys.segmentation_key(segmentation)
        with self._redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                if not pipe.exists(key):
                    return False
                pipe.multi()
                pipe.set(redis_keys.export_key(segmentation, form), record.model_dump_json())
                pipe.sadd(redis_keys.exports_key(segmentation), form)
                pipe.publish(redis_keys.channel(segmentation), b"export")
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return True

    def delete(self, segmentation: str, form: str) -> None:
        """Forget a file, or why there is none; its blob is the caller's to delete before."""
        self._redis.delete(redis_keys.export_key(segmentation, form))
        self._redis.srem(redis_keys.exports_key(segmentation), form)
