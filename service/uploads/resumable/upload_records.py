"""Uploads that are not whole yet, in Redis: whose they are, how long they are to be, and until when they are kept."""

import time

from redis import Redis

from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.record_types import UploadRecord

KEPT_SECONDS = 24 * 3600
MOST_UPLOADS = 100
"""Of one owner that are not whole yet."""


def create_upload(client: Redis, owner: str, name: str, length: int) -> UploadRecord:
    """A new one; raises `RequestProblem` where the owner has too many."""
    now = time.time()
    client.zremrangebyscore(redis_keys.uploads_key(owner), "-inf", now)
    if client.zcard(redis_keys.uploads_key(owner)) >= MOST_UPLOADS:
        detail = f"{MOST_UPLOADS} of your uploads are not whole yet. Go on with one of them, or delete it."
        raise RequestProblem("too-many-uploads", detail, limit=MOST_UPLOADS)
    record = UploadRecord(
        id=content_ids.random_token(), owner=owner, name=name, length=length, expires=now + KEPT_SECONDS
    )
    with client.pipeline() as pipe:
        pipe.set(redis_keys.upload_key(record.id), record.model_dump_json(), ex=KEPT_SECONDS)
        pipe.zadd(redis_keys.uploads_key(owner), {record.id: record.expires})
        pipe.expire(redis_keys.uploads_key(owner), KEPT_SECONDS)
        pipe.execute()
    return record


def finish_upload(client: Redis, record: UploadRecord, animation: str) -> None:
    """It is whole, and this animation; who asks for it learns that for as long as it is kept."""
    with client.pipeline() as pipe:
        whole = record.model_copy(update={"animation": animation})
        pipe.set(redis_keys.upload_key(record.id), whole.model_dump_json(), xx=True, keepttl=True)
        pipe.zrem(redis_keys.uploads_key(record.owner), record.id)
        pipe.execute()


def delete_upload(client: Redis, record: UploadRecord) -> None:
    """Forget it."""
    with client.pipeline() as pipe:
        pipe.delete(redis_keys.upload_key(record.id))
        pipe.zrem(redis_keys.uploads_key(record.owner), record.id)
        pipe.execute()


def is_known(client: Redis, identifier: str) -> bool:
    """Whether an upload is kept still."""
    return bool(client.exists(redis_keys.upload_key(identifier)))
