"""Records of files made of a result, by segmentation and form."""

import redis
from redis.client import Pipeline

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import decode_names
from caesura.worker.records.record_types import ExportRecord


class ResultFiles:
    """The files made of the results of one Redis."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def one(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return ExportRecord.read(self._redis.get(redis_keys.export_key(segmentation, form)))

    def forms(self, segmentation: str) -> list[str]:
        """The forms that were asked for."""
        return sorted(decode_names(self._redis.smembers(redis_keys.exports_key(segmentation))))

    def write(self, segmentation: str, form: str, record: ExportRecord) -> bool:
        """Keep where the file is, or why there is none; False where the segmentation was deleted meanwhile."""
        return self._keep(segmentation, form, record, instead=True)

    def add(self, segmentation: str, form: str, record: ExportRecord) -> bool:
        """The same where there is no such file yet; False where there is."""
        return self._keep(segmentation, form, record, instead=False)

    def _keep(self, segmentation: str, form: str, record: ExportRecord, *, instead: bool) -> bool:
        key, file = redis_keys.segmentation_key(segmentation), redis_keys.export_key(segmentation, form)

        def keep(pipe: Pipeline) -> None:
            takes = pipe.exists(key) and (instead or not pipe.exists(file))
            pipe.multi()
            if takes:
                pipe.set(file, record.model_dump_json())
                pipe.sadd(redis_keys.exports_key(segmentation), form)
                pipe.publish(redis_keys.channel(segmentation), b"export")

        return bool(self._redis.transaction(keep, key, file))

    def delete(self, segmentation: str, form: str) -> None:
        """Forget a file, or why there is none; its blob is the caller's to delete before."""
        self._redis.delete(redis_keys.export_key(segmentation, form))
        self._redis.srem(redis_keys.exports_key(segmentation), form)
