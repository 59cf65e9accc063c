"""The result as arrays for NumPy."""

import io
import json

import numpy as np

from caesura.formats.exports.export_table import ExportSource
from caesura.formats.streamed_file import StreamedFile


def result_npz(source: ExportSource) -> StreamedFile:
    """`energy` (frames,) float32, `labels` (frames,) uint16, `key_frames` (keys,), `segments` (segments, 3) of

    start, end, motion; `frame_rate`; and the whole document as JSON in `document`.
    """
    out, document = io.BytesIO(), source.document
    lengths = [s.end - s.start for s in document.segments]
    np.savez_compressed(
        out,
        energy=np.frombuffer(source.energy, "<f4"),
        labels=np.repeat(np.array([s.motion for s in document.segments], "<u2"), lengths),
        key_frames=np.array([key.frame for key in document.key_frames], np.int64),
        segments=np.array([[s.start, s.end, s.motion] for s in document.segments], np.int64),
        frame_rate=np.float64(document.frame_rate),
        document=np.frombuffer(json.dumps(document.model_dump(mode="json")).encode(), np.uint8),
    )
    return StreamedFile("application/x-npz", iter([out.getvalue()]))
