"""Files made of a result that need arrays: the web process has none, so a `cut` job makes them."""

import io
import json
from collections.abc import Callable

import numpy as np

from core.document import SegmentationDocument
from worker.attempt import INTERNAL_ERROR
from worker.blobs import Blobs
from worker.records import Records
from worker.schema import ExportRecord


def npz(document: SegmentationDocument, energy: bytes, labels: bytes) -> bytes:
    """`energy` (frames,) float32, `labels` (frames,) uint16, `key_frames` (keys,), `segments` (segments, 3) of

    start, end, motion; `frame_rate`; and the whole document as JSON in `document`.
    """
    out = io.BytesIO()
    np.savez_compressed(
        out,
        energy=np.frombuffer(energy, "<f4"),
        labels=np.frombuffer(labels, "<u2"),
        key_frames=np.array([key.frame for key in document.key_frames], np.int64),
        segments=np.array([[s.start, s.end, s.motion] for s in document.segments], np.int64),
        frame_rate=np.float64(document.frame_rate),
        document=np.frombuffer(json.dumps(document.model_dump(mode="json")).encode(), np.uint8),
    )
    return out.getvalue()


Writer = Callable[[SegmentationDocument, bytes, bytes], bytes]
FORMS: dict[str, tuple[str, Writer]] = {"npz": ("application/octet-stream", npz)}


def run(records: Records, blobs: Blobs, identifier: str, form: str) -> None:
    """Write one form of one result, and say where it is; a failure is said too, and then raised."""
    document, energy, labels = records.result(identifier)
    if document is None or energy is None or labels is None:
        return  # deleted meanwhile
    media_type, write = FORMS[form]
    try:
        content = write(SegmentationDocument.model_validate_json(document), energy, labels)
        made = ExportRecord(key=blobs.put(content, "exports"), media_type=media_type)
    except Exception:
        records.write_export(identifier, form, ExportRecord(problem=INTERNAL_ERROR))
        raise
    records.write_export(identifier, form, made)
