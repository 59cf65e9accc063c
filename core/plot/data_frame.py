"""The result as a table: columns by name, and the data frame that pandas or polars makes of them. Light: no NumPy."""

from collections.abc import Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from caesura.core.errors import ParameterError
from caesura.core.segmentation_document import SegmentationDocument

Columns = dict[str, Sequence[Any]]
LIBRARIES = ("pandas", "polars")


def make_data_frame(columns: Columns, library: str = "auto") -> Any:
    """A data frame of pandas or polars; `auto` is the first of the two that is installed.

    Raises `ParameterError` where it is neither of them, and ImportError where it is not installed.
    """
    if library not in {"auto", *LIBRARIES}:
        detail = f"library = {library!r} is not possible: it is 'pandas', 'polars' or 'auto'."
        raise ParameterError("invalid-parameter", detail, parameter="library")
    for name in LIBRARIES if library == "auto" else (library,):
        if find_spec(name) is not None:
            return import_module(name).DataFrame(columns)
    missing = "pandas or polars" if library == "auto" else library
    raise ImportError(f"A data frame needs {missing}, which is not installed: pip install {missing.split()[0]}.")


def export_columns(document: SegmentationDocument, rows: str) -> Columns:
    """The columns of the CSV exports, as numbers: a row for each segment, frame or key-frame."""
    if rows == "segments":
        return _segment_columns(document)
    if rows == "frames":
        return _frame_columns(document)
    if rows == "key_frames":
        keys = document.key_frames
        return {name: [getattr(key, name) for key in keys] for name in ("frame", "seconds", "motion", "energy")}
    detail = f"rows = {rows!r} is not possible: it is 'segments', 'frames' or 'key_frames'."
    raise ParameterError("invalid-parameter", detail, parameter="rows")


def _segment_columns(document: SegmentationDocument) -> Columns:
    names = ("name", "motion", "start", "end", "start_seconds", "end_seconds", "confidence", "loop", "discard")
    columns: Columns = {name: [getattr(segment, name) for segment in document.segments] for name in names}
    return {**columns, "repeats": [len(segment.repeats) for segment in document.segments]}


def _frame_columns(document: SegmentationDocument) -> Columns:
    start, rate = document.source.start_seconds, document.frame_rate
    of_frames = [segment for segment in document.segments for _ in range(segment.start, segment.end)]
    keys = {key.frame for key in document.key_frames}
    return {
        "frame": list(range(document.frames)),
        "seconds": [start + frame / rate for frame in range(document.frames)],
        "motion": [segment.motion for segment in of_frames],
        "name": [segment.name for segment in of_frames],
        "energy": [float("nan") if value is None else value for value in document.energy],
        "key_frame": [frame in keys for frame in range(document.frames)],
    }
