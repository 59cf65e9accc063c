"""The jobs of a worker: read an upload, analyse it, cut it, store the result. Each function is one RQ job."""

import time
from contextlib import suppress

from caesura.core.analysis import Analysis
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, cut_into_other_motion_counts
from caesura.core.repetition.loops import search_loops
from caesura.core.revision import kept_repeats
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.playback.playback_files import make_playback
from caesura.formats.read import read_animation
from caesura.worker import result_file_writers
from caesura.worker.collections import jobs as collection_jobs
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.thread_count import available_threads
from caesura.worker.process.warm_up import rehearse_cuts
from caesura.worker.process.worker_context import stored_analysis, worker_context
from caesura.worker.queue.attempt import Attempt, Superseded, run_attempt
from caesura.worker.queue.auxiliary_jobs import submit_alternatives
from caesura.worker.records import content_ids
from caesura.worker.records.record_types import AnalysisRecord, AnimationRecord, ViewerRecord
from caesura.worker.records.revisions import EDITS, keep_searched_loops
from caesura.worker.retention.sweep import sweep_by_clock
from caesura.worker.store.blobs import BlobMissing, Blobs
from caesura.worker.store.memory_maps import map_parts, scratch_space
from caesura.worker.stored_alternatives import store_alternative

DAY = 24 * 3600.0


def prepare() -> None:
    """Connect and rehearse, before there is a job."""
    worker_context().jobs.redis.ping()
    rehearse_cuts()


def run_analyse(identifier: str, token: str) -> None:
    """The job of the queue `analyse`: from the vertices to the result."""
    run_attempt(worker_context().jobs, identifier, token, _analyse)


def run_cut(identifier: str, token: str) -> None:
    """The job of the queue `cut`: another cut of a stored analysis. It never sees a vertex."""
    run_attempt(worker_context().jobs, identifier, token, _cut)


def run_alternatives(identifier: str) -> None:
    """The result for every other number of motions that it scored: nobody waits for them, and none is a must."""
    settings, records = worker_context().settings, worker_context().jobs.records
    record, (document, _, _) = records.segmentations.one(identifier), records.segmentations.result(identifier)
    if record is None or record.analysis is None or document is None:
        return  # deleted meanwhile
    JobQuota(settings.job_memory_bytes, settings.job_seconds)
    found = SegmentationDocument.model_validate_json(document)
    scored = [score.motions for score in found.scores]
    with suppress(BlobMissing):
        analysis = stored_analysis(record.analysis.key)
        for made in cut_into_other_motion_counts(analysis, record.chosen(), scored, found.motions):
            if not store_alternative(records, identifier, made.document()):
                return


def run_loops(identifier: str, token: str, edits: str) -> None:
    """The best loops of segments that a person has cut otherwise: somebody waits a moment for them."""
    settings, records = worker_context().settings, worker_context().jobs.records
    record, (document, _, _) = records.segmentations.one(identifier), records.segmentations.result(identifier)
    if record is None or record.analysis is None or document is None:
        return  # deleted meanwhile
    JobQuota(settings.job_memory_bytes, settings.job_seconds)
    with suppress(BlobMissing):
        segments = SegmentationDocument.model_validate_json(document).segments
        parts = [(edit.start, edit.end, kept_repeats(segments, edit)) for edit in EDITS.validate_json(edits)]
        loops = search_loops(stored_analysis(record.analysis.key), parts)
        keep_searched_loops(records, identifier, token, loops)


def run_export(identifier: str, form: str) -> None:
    """A file made of a result, for the web process has no arrays."""
    here = worker_context()
    result_file_writers.make_result_file(here.jobs.records, here.blobs, here.settings, identifier, form)


def run_collect(identifier: str) -> None:
    """Takes that wait in a collection, measured and labelled."""
    collection_jobs.run_labelling(worker_context(), identifier)


def run_propose(identifier: str, proposal: str) -> None:
    """What a proposal would change."""
    collection_jobs.run_proposal(worker_context(), identifier, proposal)


def run_search(identifier: str, search: str) -> None:
    """What is like an example."""
    collection_jobs.run_search(worker_context(), identifier, search)


def run_sweep() -> None:
    """Forget what is kept too long."""
    settings, jobs, blobs = worker_context().settings, worker_context().jobs, worker_context().blobs
    sweep_by_clock(jobs, blobs, settings.keep_upload_days * DAY, settings.keep_result_days * DAY, time.time())


def _analyse(attempt: Attempt) -> None:
    record, parameters = attempt.record, attempt.record.chosen()
    settings, blobs = worker_context().settings, worker_context().blobs
    digest = content_ids.heavy_digest(parameters.heavy(), record.algorithm)
    threads = settings.threads or available_threads()
    uploaded = _read_upload(attempt)
    allowance = JobQuota(settings.job_memory_bytes, settings.job_seconds * threads)
    attempt.progress("read", 0.0)
    with map_parts(blobs, uploaded.parts, allowance.extend) as parts:
        scratch = scratch_space(settings.scratch_dir, allowance.extend)
        animation = read_animation(parts, parameters, settings.limits, scratch)
        analysis = analyse(animation, parameters, threads=threads, progress=attempt.progress)
        shown = make_playback(animation, analysis, threads=threads, progress=attempt.progress)
        viewer = ViewerRecord(
            document=shown.document,
            model=blobs.put(shown.model, "viewer"),
            strain=None if shown.strain is None else blobs.put(shown.strain, "viewer"),
            materials=None if shown.materials is None else blobs.put(shown.materials, "viewer"),
        )
    made = AnalysisRecord(key=blobs.put(analysis.to_bytes(), "analyses"), viewer=viewer)
    kept = _store_analysis(attempt, blobs, digest, made)
    _store_result(attempt, kept, analysis, parameters)


def _store_analysis(attempt: Attempt, blobs: Blobs, digest: str, made: AnalysisRecord) -> AnalysisRecord:
    """Keep the analysis. Where another job made the same one meanwhile, its blobs stay and these go."""
    kept = attempt.records.analyses.add(attempt.record.animation, digest, made)
    if kept != made:
        for key in made.blobs():
            blobs.delete(key)
    if kept is None:
        raise Superseded
    return kept


def _cut(attempt: Attempt) -> None:
    record, parameters, settings = attempt.record, attempt.record.chosen(), worker_context().settings
    digest = content_ids.heavy_digest(parameters.heavy(), record.algorithm)
    JobQuota(settings.job_memory_bytes, settings.job_seconds)
    stored = attempt.records.analyses.one(record.animation, digest)
    if stored is not None:
        with suppress(BlobMissing):
            analysis = stored_analysis(stored.key)
            _store_result(attempt, stored, analysis, parameters)
            return
        attempt.records.analyses.delete(record.animation, digest)
    attempt.jobs.hand_back(record.id, record.token, queue="analyse")


def _store_result(attempt: Attempt, stored: AnalysisRecord, analysis: Analysis, parameters: Parameters) -> None:
    attempt.progress("cut", 0.0)
    result = cut(analysis, parameters)
    document = result.document(attempt.record.id)
    finished = attempt.records.attempts.finish(
        attempt.record.id,
        attempt.record.token,
        document.model_dump_json(),
        {"energy": result.energy.astype("<f4").tobytes(), "labels": result.labels.astype("<u2").tobytes()},
        analysis=stored,
        motions=document.motions,
        frames=document.frames,
        segments=document.segments,
    )
    if finished and document.scores:
        submit_alternatives(attempt.jobs, attempt.record.id)


def _read_upload(attempt: Attempt) -> AnimationRecord:
    found = attempt.records.animations.one(attempt.record.animation)
    if found is None or not found.parts:
        raise BlobMissing(attempt.record.animation)
    return found
