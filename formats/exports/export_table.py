"""The files that are made of a result, by address: to add one, write its file and add its line here. Light: no NumPy.

The API's answers, OpenAPI, GET /v1/exports and with it the page's menu, the worker and the command read this table.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from mmap import mmap
from typing import Any

from caesura.core.limits import Limits
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.streamed_file import StreamedFile

Parts = Mapping[str, bytes | memoryview | mmap]


@dataclass(frozen=True)
class ExportSource:
    """What a file is made of: the result; of exports of the upload also its parts and where to inflate them."""

    document: SegmentationDocument
    energy: bytes = b""
    """The energy curve, float32."""
    font: Callable[[], bytes | None] = lambda: None
    """Reads the TrueType font for pictures; None for the usual one."""
    parts: Parts = field(default_factory=dict)
    options: ClipOptions = field(default_factory=ClipOptions)
    scratch: Callable[[int], memoryview] = lambda size: memoryview(bytearray(size))
    limits: Limits = field(default_factory=Limits.none)
    """Within which the upload is read again."""


@dataclass(frozen=True)
class Export:
    """One file: its address below a segmentation, its media type, and how people and the command call it."""

    path: str
    title: str
    description: str
    media_type: str
    writer: str
    """The place of its function below `formats.exports`: from the document to text, or from a source to a file."""
    is_text: bool = False
    of_upload: bool = False
    """Whether it is made of the uploaded file, which must still be there."""
    table: str = "segments"
    option: str = ""
    """The command's option for it, and what the option's help says."""
    option_help: str = ""
    example: str = ""
    """For OpenAPI."""

    @property
    def stem(self) -> str:
        """The address without its suffix: `result` of `result.csv`."""
        return self.path.partition(".")[0]

    @property
    def suffix(self) -> str:
        """`csv` of `result.csv`; of an address without a suffix the address."""
        return self.path.rpartition(".")[2]

    @property
    def queued(self) -> bool:
        """Whether a worker makes it, for want of arrays or of time in the web process."""
        return not self.is_text

    def file_ending(self, media_type: str) -> str:
        """How the name of a file ends that the command writes: `.csv`, `.frames.csv`, `.clips.glb`."""
        if self.of_upload:
            return f".{self.path}.{'zip' if media_type == 'application/zip' else 'glb'}"
        return f".{self.suffix}" if self.table == "segments" else f".{self.table}.{self.suffix}"

    def text(self, document: SegmentationDocument) -> str:
        """The file of a text export."""
        return str(self._load()(document))

    def write(self, source: ExportSource) -> StreamedFile:
        """The file; raises `ParameterError` or `InvalidModel` where this result has none."""
        if self.is_text:
            return StreamedFile(self.media_type, iter([self.text(source.document).encode()]))
        written: StreamedFile = self._load()(source)
        return written

    def _load(self) -> Callable[..., Any]:
        module, _, name = self.writer.partition(":")
        loaded: Callable[..., Any] = getattr(import_module(f"caesura.formats.exports.{module}"), name)
        return loaded


_text = partial(Export, is_text=True)

EXPORTS = (
    Export(
        "clips", "Clips", "one animation for each segment", "model/gltf-binary", "clips_and_key_poses:clips",
        of_upload=True, option="clips",
        option_help="Write the file again with its motions as clips: a GLB, or a zip of such files.",
    ),
    Export(
        "keyframes", "Key-frames", "one animation of the key poses", "model/gltf-binary",
        "clips_and_key_poses:key_poses", of_upload=True, option="keyframes",
        option_help="Write the file again with its key poses alone, as a GLB.",
    ),
    _text("result.json", "JSON", "the whole result", "application/json", "json_document:document_json"),
    _text(
        "result.csv", "CSV", "one line for each segment", "text/csv", "csv_tables:segments_csv",
        option="csv", option_help="Write the segments as CSV.",
        example="name,motion,start,end,start_seconds,end_seconds,confidence,loop,discard\n"
        "A,0,0,205,0.000000,6.833333,0.91,0,0\n",
    ),
    _text(
        "result.csv", "CSV of frames", "one line for each frame", "text/csv", "csv_tables:frames_csv", table="frames",
        option="frames_csv", option_help="Write motion and energy of every frame as CSV.",
    ),
    Export("result.npz", "NPZ", "arrays for NumPy", "application/x-npz", "npz_arrays:result_npz"),
    _text(
        "result.vtt", "VTT", "subtitles for a video", "text/vtt", "webvtt:segments_vtt",
        option="vtt", option_help="Write the segments as WebVTT, for video players.",
        example="WEBVTT\n\n00:00:00.000 --> 00:00:06.833\nA\n",
    ),
    _text(
        "result.eaf", "EAF", "annotations for ELAN", "text/x-eaf+xml", "elan:segments_eaf",
        option="eaf", option_help="Write motions and key-frames as EAF, for ELAN.",
    ),
    _text(
        "plot.svg", "Plot, SVG", "a figure for a paper", "image/svg+xml", "plot:plot_svg",
        option="plot", option_help="Draw the energy curve over the segments as SVG, for papers.",
    ),
    Export(
        "plot.png", "Plot, PNG", "the same as an image", "image/png", "plot:plot_png",
        option="plot_png", option_help="Draw the same as PNG.",
    ),
)  # fmt: skip


def exports_of(stem: str, table: str = "segments") -> dict[str, Export]:
    """The exports whose address begins with `stem`, by suffix."""
    return {export.suffix: export for export in EXPORTS if (export.stem, export.table) == (stem, table)}
