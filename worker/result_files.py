"""Files made of a result that need arrays: the web process has none, so a `cut` job makes them.

A form is a name, and after a question mark the revision and the options that are not the default ones:
`clips?revision=3&origin=keep`.
"""

import io
import json
import logging
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from urllib.parse import parse_qsl

import numpy as np

from caesura.core.document import SegmentationDocument
from caesura.core.plot.layout import lay_out_picture
from caesura.core.plot.png import render_png
from caesura.core.revision import apply_revision
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.write import Parts, Scratch, WrittenFile, write_clips, write_key_poses
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.queue.job_problems import INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records import Records
from caesura.worker.records.connection import tolerate_full_disk
from caesura.worker.records.revisions import edits_of
from caesura.worker.records.schema import ExportRecord, SegmentationRecord
from caesura.worker.retention.deletion import delete_oldest_result_files
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.blobs import BlobMissing, Blobs
from caesura.worker.store.memory_maps import map_parts, scratch_space

log = logging.getLogger(__name__)

MOST_EXPORTS = 16
"""Files made of one result that are kept, and answers why there is none: choices and revisions are many, and each may
ask for a copy of the upload."""

ResultFileOptions = dict[str, str]


@dataclass(frozen=True)
class ResultFileJob:
    """What a file is made of; `keep` stores it."""

    records: Records
    blobs: Blobs
    settings: WorkerSettings
    record: SegmentationRecord
    document: SegmentationDocument
    energy: bytes

    def keep(self, content: bytes | Iterator[bytes], media_type: str) -> ExportRecord:
        """Where the file is, from now on; raises `StorageFull`."""
        key = self.blobs.put(content, "exports", self.settings.min_free_bytes)
        return ExportRecord(key=key, media_type=media_type, created=time.time())


def npz(export: ResultFileJob, _: ResultFileOptions) -> ExportRecord:
    """`energy` (frames,) float32, `labels` (frames,) uint16, `key_frames` (keys,), `segments` (segments, 3) of

    start, end, motion; `frame_rate`; and the whole document as JSON in `document`.
    """
    out, document = io.BytesIO(), export.document
    lengths = [s.end - s.start for s in document.segments]
    np.savez_compressed(
        out,
        energy=np.frombuffer(export.energy, "<f4"),
        labels=np.repeat(np.array([s.motion for s in document.segments], "<u2"), lengths),
        key_frames=np.array([key.frame for key in document.key_frames], np.int64),
        segments=np.array([[s.start, s.end, s.motion] for s in document.segments], np.int64),
        frame_rate=np.float64(document.frame_rate),
        document=np.frombuffer(json.dumps(document.model_dump(mode="json")).encode(), np.uint8),
    )
    return export.keep(out.getvalue(), "application/octet-stream")


def plot(export: ResultFileJob, _: ResultFileOptions) -> ExportRecord:
    """The curve, its key-frames, the cuts and the segments in colour."""
    font = export.settings.font
    return export.keep(render_png(lay_out_picture(export.document), font.read_bytes() if font else None), "image/png")


def clips(export: ResultFileJob, options: ResultFileOptions) -> ExportRecord:
    """The upload with its take in clips."""
    chosen = ClipOptions.of(options)
    return _of_upload(export, lambda parts, scratch: write_clips(parts, export.document, chosen, scratch))


def keyframes(export: ResultFileJob, _: ResultFileOptions) -> ExportRecord:
    """The upload with its take reduced to key poses."""
    return _of_upload(export, lambda parts, scratch: write_key_poses(parts, export.document, scratch))


def _of_upload(export: ResultFileJob, write: Callable[[Parts, Scratch], WrittenFile]) -> ExportRecord:
    """A file made of the uploaded one, which must still be there."""
    animation = export.records.animations.one(export.record.animation)
    if animation is None or not animation.parts:
        raise BlobMissing(export.record.animation)
    settings = export.settings
    allowance = JobQuota(settings.job_memory_bytes, settings.job_seconds)
    with map_parts(export.blobs, animation.parts, allowance.extend) as parts:
        written = write(parts, scratch_space(settings.scratch_dir, allowance.extend, settings.min_free_bytes))
        return export.keep(written.pieces, written.media_type)


ResultFileWriter = Callable[[ResultFileJob, ResultFileOptions], ExportRecord]
WRITERS: dict[str, ResultFileWriter] = {"npz": npz, "png": plot, "clips": clips, "keyframes": keyframes}


def make_result_file(records: Records, blobs: Blobs, settings: WorkerSettings, identifier: str, form: str) -> None:
    """Write one form of one result, and say where it is, or why there is none; a bug is logged."""
    name, _, query = form.partition("?")
    options = dict(parse_qsl(query))
    record = records.segmentations.one(identifier)
    document, energy, _ = records.segmentations.result(identifier)
    revision = int(options.pop("revision", "0"))
    edits = edits_of(records, identifier, revision) if revision else ()
    if record is None or document is None or energy is None or edits is None:
        return  # deleted meanwhile
    result = SegmentationDocument.model_validate_json(document)
    if revision:
        result = apply_revision(result, revision, edits)
    export = ResultFileJob(records, blobs, settings, record, result, energy)
    try:
        made = WRITERS[name](export, options)
    except (Exception, TimeLimit) as fault:
        made = ExportRecord(problem=problem_of(fault), created=time.time())
        if made.problem == INTERNAL_ERROR:
            log.exception("%s of %s cannot be made", form, identifier)
    written = False
    with tolerate_full_disk():
        written = records.exports.write(identifier, form, made)
    if not written and made.key is not None:
        blobs.delete(made.key)
    delete_oldest_result_files(records, blobs, identifier, MOST_EXPORTS)
