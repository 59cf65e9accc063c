"""Reading and changing records. Every change is one MULTI that also tells it on the segmentation's channel."""

import time
from collections.abc import Callable, Iterable
from typing import Any

import redis
from redis.client import Pipeline

from core.errors import CaesuraError
from worker import keys, tallies
from worker.schema import AnalysisRecord, AnimationRecord, ExportRecord, SegmentationRecord

LEASE_SECONDS = 20  # an attempt whose worker gave no sign for so long is lost

Change = Callable[[SegmentationRecord], SegmentationRecord | None]
Also = Callable[[Pipeline, SegmentationRecord], None]


class AnimationDeleted(CaesuraError):
    """A segmentation was asked for of what is not there any more."""

    kind = "request"


def connect(url: str) -> redis.Redis:
    """A client for short calls; it connects at first use."""
    return redis.Redis.from_url(url, health_check_interval=30)


class Records:
    """The records of one Redis, for workers and thread pools."""

    def __init__(self, client: redis.Redis) -> None:
        self.redis = client

    # Animations.

    def add_animation(self, record: AnimationRecord) -> tuple[AnimationRecord, bool]:
        """Keep a new animation: (the record that is kept, whether it is this one).

        Where it was there before, with its files, the stored record is answered; the caller then deletes its own.
        """
        key = keys.animation_key(record.id)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                kept = AnimationRecord.read(pipe.get(key))
                if kept is not None and kept.parts:
                    return kept, False
                pipe.multi()
                pipe.set(key, record.model_dump_json())
                pipe.zadd(keys.animations_key(record.owner), {record.id: record.created})
                pipe.zadd(keys.USED_KEY, {record.id: record.created})
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return record, True

    def strip_animation(self, record: AnimationRecord) -> None:
        """Forget where its files were: they are gone."""
        self.redis.set(
            keys.animation_key(record.id), record.model_copy(update={"parts": ()}).model_dump_json(), xx=True
        )

    def uses(self) -> dict[str, float]:
        """When each animation was used last: uploaded, or asked to be cut."""
        return {name: score for (name,), score in ((names([n]), s) for n, s in self.redis.zscan_iter(keys.USED_KEY))}

    def animation(self, identifier: str) -> AnimationRecord | None:
        """The animation, or None."""
        return AnimationRecord.read(self.redis.get(keys.animation_key(identifier)))

    def touch_animation(self, identifier: str) -> None:
        """It is used now, and so kept from now on."""
        self.redis.zadd(keys.USED_KEY, {identifier: time.time()}, xx=True)

    def delete_animation(self, record: AnimationRecord) -> bool:
        """Forget an animation; its blobs, analyses and segmentations are the caller's to delete before.

        False, and nothing is forgotten, where it has segmentations: one was asked for in this moment.
        """
        with self.redis.pipeline() as pipe:
            pipe.watch(keys.segmentations_key(record.id))
            if pipe.exists(keys.segmentations_key(record.id)):
                return False
            pipe.multi()
            pipe.delete(keys.animation_key(record.id))
            pipe.zrem(keys.animations_key(record.owner), record.id)
            pipe.zrem(keys.USED_KEY, record.id)
            try:
                pipe.execute()
            except redis.WatchError:
                return False
            return True

    # Analyses.

    def analysis(self, animation: str, digest: str) -> AnalysisRecord | None:
        """The analysis of an animation with certain heavy parameters (`ids.heavy_digest`), or None."""
        return AnalysisRecord.read(self.redis.get(keys.analysis_key(animation, digest)))

    def add_analysis(self, animation: str, digest: str, record: AnalysisRecord) -> AnalysisRecord | None:
        """Keep an analysis, and answer the one that is kept: this, or another that was there before.

        None where the animation was deleted meanwhile: then nothing is kept.
        """
        key = keys.analysis_key(animation, digest)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(keys.animation_key(animation))
                if not pipe.exists(keys.animation_key(animation)):
                    return None
                pipe.multi()
                pipe.set(key, record.model_dump_json(), nx=True)
                pipe.sadd(keys.analyses_key(animation), digest)
                pipe.get(key)
                try:
                    return AnalysisRecord.model_validate_json(pipe.execute()[-1])
                except redis.WatchError:
                    continue

    def analyses(self, animation: str) -> dict[str, AnalysisRecord]:
        """All analyses of an animation, by digest."""
        digests = sorted(names(self.redis.smembers(keys.analyses_key(animation))))
        found = {digest: self.analysis(animation, digest) for digest in digests}
        return {digest: record for digest, record in found.items() if record is not None}

    def delete_analysis(self, animation: str, digest: str) -> None:
        """Forget an analysis; its blobs are the caller's to delete."""
        with self.redis.pipeline() as pipe:
            pipe.delete(keys.analysis_key(animation, digest))
            pipe.srem(keys.analyses_key(animation), digest)
            pipe.execute()

    # Segmentations.

    def segmentation(self, identifier: str) -> SegmentationRecord | None:
        """The segmentation, or None."""
        return SegmentationRecord.read(self.redis.get(keys.segmentation_key(identifier)))

    def segmentations(self, animation: str) -> list[SegmentationRecord]:
        """All segmentations of an animation, newest first."""
        ids = names(self.redis.zrevrange(keys.segmentations_key(animation), 0, -1))
        return [record for record in map(self.segmentation, ids) if record is not None]

    def live(self) -> list[SegmentationRecord]:
        """All segmentations that are queued or running."""
        ids = sorted(names(self.redis.smembers(keys.LIVE_KEY)))
        return [record for record in map(self.segmentation, ids) if record is not None and record.live]

    def change(
        self, identifier: str, change: Change, also: Also | None = None, new: SegmentationRecord | None = None
    ) -> SegmentationRecord | None:
        """Replace the record by `change(record)`, together with what `also` puts into the same MULTI.

        `change` sees the stored record, or `new` where there is none, and may answer None: nothing happens then,
        and None is answered. It is called again where another process wrote in between, so it must be pure.
        Raises `AnimationDeleted` where it would be `new`, and what it is of has gone meanwhile.
        """
        key = keys.segmentation_key(identifier)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                stored = SegmentationRecord.read(pipe.get(key))
                if stored is None and new is not None:
                    _watch_animation(pipe, new.animation)
                before = stored or new
                after = None if before is None else change(before)
                if after is None:
                    pipe.unwatch()
                    return None
                after = after.with_(updated=time.time())
                pipe.multi()
                self._write(pipe, after)
                tallies.count_change(pipe, before, after)
                if also is not None:
                    also(pipe, after)
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return after

    def of_attempt(self, token: str, identifier: str, **changes: Any) -> SegmentationRecord | None:
        """Change a running segmentation's fields where `token` is still its attempt; None where it is not."""
        return self.change(identifier, lambda r: r.with_(**changes) if _running(r, token) else None)

    def begin(self, identifier: str, token: str) -> SegmentationRecord | None:
        """queued -> running; None where this attempt is no longer wanted, or has begun before."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            wanted = record.token == token and record.status == "queued"
            return record.with_(status="running", stage="", fraction=0.0) if wanted else None

        return self.change(identifier, change, lambda pipe, _: self.renew(token, pipe))

    def renew(self, token: str, client: redis.Redis | None = None) -> None:
        """Say that the attempt's worker lives."""
        (client or self.redis).set(keys.lease_key(token), b"1", ex=LEASE_SECONDS)

    def finish(self, identifier: str, token: str, document: str, arrays: dict[str, bytes], **summary: Any) -> bool:
        """running -> done, with the result document and the byte arrays `energy` and `labels`, all at once."""

        def also(pipe: Pipeline, _: SegmentationRecord) -> None:
            pipe.set(keys.segmentation_key(identifier, "document"), document)
            pipe.set(keys.segmentation_key(identifier, "energy"), arrays["energy"])
            pipe.set(keys.segmentation_key(identifier, "labels"), arrays["labels"])

        done = {"status": "done", "stage": "", "fraction": 1.0, "problem": None, **summary}
        change: Change = lambda r: r.with_(**done) if _running(r, token) else None  # noqa: E731  one line says it
        return self.change(identifier, change, also) is not None

    def fail(self, identifier: str, token: str, problem: dict[str, Any]) -> bool:
        """running -> failed, with the problem that is answered from now on."""
        return self.of_attempt(token, identifier, status="failed", problem=problem) is not None

    def result(self, identifier: str) -> tuple[bytes | None, bytes | None, bytes | None]:
        """The result document, the energy curve and the labels, as stored."""
        with self.redis.pipeline() as pipe:
            for part in ("document", "energy", "labels"):
                pipe.get(keys.segmentation_key(identifier, part))
            document, energy, labels = pipe.execute()
            return document, energy, labels

    def delete_segmentation(self, record: SegmentationRecord) -> bool:
        """Forget a segmentation and its result; False, and nothing is forgotten, where it is live again: cancel it."""
        with self.redis.pipeline() as pipe:
            key = keys.segmentation_key(record.id)
            pipe.watch(key)
            kept = SegmentationRecord.read(pipe.get(key))
            if kept is not None and kept.live:
                return False
            pipe.multi()
            parts = [keys.segmentation_key(record.id, part) for part in ("document", "energy", "labels")]
            pipe.delete(key, *parts, keys.revisions_key(record.id), keys.revised_key(record.id))
            pipe.delete(keys.alternatives_key(record.id))
            pipe.zrem(keys.segmentations_key(record.animation), record.id)
            pipe.srem(keys.LIVE_KEY, record.id)
            pipe.publish(keys.channel(record.id), b"deleted")
            try:
                pipe.execute()
            except redis.WatchError:
                return False
            return True

    # Exports.

    def export(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return ExportRecord.read(self.redis.get(keys.export_key(segmentation, form)))

    def exports(self, segmentation: str) -> list[str]:
        """The forms that were asked for."""
        return sorted(names(self.redis.smembers(keys.exports_key(segmentation))))

    def write_export(self, segmentation: str, form: str, record: ExportRecord) -> bool:
        """Keep where the file is, or why there is none; False where the segmentation was deleted meanwhile."""
        key = keys.segmentation_key(segmentation)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                if not pipe.exists(key):
                    return False
                pipe.multi()
                pipe.set(keys.export_key(segmentation, form), record.model_dump_json())
                pipe.sadd(keys.exports_key(segmentation), form)
                pipe.publish(keys.channel(segmentation), b"export")
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return True

    @staticmethod
    def _write(pipe: Pipeline, record: SegmentationRecord) -> None:
        pipe.set(keys.segmentation_key(record.id), record.model_dump_json())
        pipe.zadd(keys.segmentations_key(record.animation), {record.id: record.created})
        (pipe.sadd if record.live else pipe.srem)(keys.LIVE_KEY, record.id)
        pipe.publish(keys.channel(record.id), record.status)


def _watch_animation(pipe: Pipeline, identifier: str) -> None:
    """Whoever deletes it from now on spoils the MULTI: nothing is kept that nobody would delete any more."""
    pipe.watch(keys.animation_key(identifier))
    if not pipe.exists(keys.animation_key(identifier)):
        raise AnimationDeleted("animation-deleted", "The animation was deleted meanwhile. Upload it again.")


def _running(record: SegmentationRecord, token: str) -> bool:
    return record.token == token and record.status == "running"


def names(values: Iterable[Any]) -> list[str]:
    """Redis's values as text; redis-py types them `bytes | str`, but without `decode_responses` they are bytes."""
    return [bytes(value).decode() for value in values]
