"""Files made of a result that need arrays: the web process has none, so a `cut` job makes them.

A form is a name, and after a question mark the revision and the options that are not the default ones:
`clips?revision=3&origin=keep`.
"""

import logging
import time
from dataclasses import dataclass, replace
from urllib.parse import parse_qsl

from caesura.core.revision import apply_revision
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.exports.export_table import EXPORTS, Export, ExportSource
from caesura.formats.streamed_file import StreamedFile
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.queue.job_problems import INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records import Records
from caesura.worker.records.connection import tolerate_full_disk
from caesura.worker.records.record_types import ExportRecord, SegmentationRecord
from caesura.worker.records.revisions import read_edits, read_loops
from caesura.worker.retention.deletion import delete_oldest_result_files
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.blobs import BlobMissing, Blobs
from caesura.worker.store.memory_maps import map_parts, scratch_space

log = logging.getLogger(__name__)

MOST_EXPORTS = 16
"""Files made of one result that are kept, and answers why there is none: choices and revisions are many, and each may
ask for a copy of the upload."""

WRITERS = {export.suffix: export for export in EXPORTS if export.queued}
"""The exports that a job makes, by the names of their forms."""


@dataclass(frozen=True)
class ResultFileJob:
    """What a file is made of."""

    records: Records
    blobs: Blobs
    settings: WorkerSettings
    record: SegmentationRecord
    source: ExportSource

    def make(self, export: Export) -> ExportRecord:
        """Where the file is, from now on; raises `StorageFull`, or `BlobMissing` where the upload is gone."""
        if not export.of_upload:
            return self._keep(export.write(self.source))
        animation = self.records.animations.one(self.record.animation)
        if animation is None or not animation.parts:
            raise BlobMissing(self.record.animation)
        settings = self.settings
        quota = JobQuota(settings.job_memory_bytes, settings.job_seconds)
        with map_parts(self.blobs, animation.parts, quota.extend) as parts:
            scratch = scratch_space(settings.scratch_dir, quota.extend, settings.min_free_bytes)
            return self._keep(export.write(replace(self.source, parts=parts, scratch=scratch)))

    def _keep(self, written: StreamedFile) -> ExportRecord:
        key = self.blobs.put(written.pieces, "exports", self.settings.min_free_bytes)
        return ExportRecord(key=key, media_type=written.media_type, created=time.time())


def make_result_file(records: Records, blobs: Blobs, settings: WorkerSettings, identifier: str, form: str) -> None:
    """Write one form of one result, and say where it is, or why there is none; a bug is logged."""
    name, _, query = form.partition("?")
    options = dict(parse_qsl(query))
    record = records.segmentations.one(identifier)
    document, energy, _ = records.segmentations.result(identifier)
    revision = int(options.pop("revision", "0"))
    edits = read_edits(records, identifier, revision) if revision else ()
    if record is None or document is None or energy is None or edits is None:
        return  # deleted meanwhile
    result = SegmentationDocument.model_validate_json(document)
    if revision:
        result = apply_revision(result, revision, edits, read_loops(records, identifier, revision))
    try:
        source = ExportSource(
            result,
            energy,
            font=lambda: settings.font.read_bytes() if settings.font else None,
            options=ClipOptions.of(options),
            limits=settings.limits,
        )
        made = ResultFileJob(records, blobs, settings, record, source).make(WRITERS[name])
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
