"""Clips of a USD: the stage flattened into one layer for each segment, in text, skeletons and all."""

from collections.abc import Iterator, Sequence

from caesura.formats.clips.clip_plan import Clip
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.native.reader_process import NativeReader, ReaderProcess
from caesura.formats.native.usd.usdz import first_layer
from caesura.formats.zip.stream_writer import stream_zip

USD_CLIPS = NativeReader("USD", "pxr", "caesura.formats.native.usd.stage_cut:cut_stage", extra="usd")
AT_ONCE = 1000
"""Clips that one process makes: what they are is an argument of its start."""


def write_usd_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip of one `.usda` for each clip, frames [start, end). Native code writes it: in a process of its own."""
    USD_CLIPS.require_library()
    groups = (request.clips[first : first + AT_ONCE] for first in range(0, len(request.clips), AT_ONCE))
    return stream_zip((layer for group in groups for layer in _layers(request, group)), deflated=True)


def _layers(request: ClipRequest, clips: Sequence[Clip]) -> Iterator[tuple[str, list[bytes]]]:
    rate, begin = request.document.frame_rate, request.document.source.start_seconds
    ranges = [
        (begin + clip.start_frame / rate, begin + clip.end_frame / rate, clip.extras.get("handles_seconds", 0.0))
        for clip in clips
    ]
    arguments = {"ranges": ranges, "from_zero": request.options.origin != "keep"}
    limits = request.limits
    with ReaderProcess(USD_CLIPS, first_layer(request.model.data, limits), limits, arguments) as process:
        process.receive()
        for clip in clips:
            length = int(process.receive()["bytes"])
            limits.check("max_reader_bytes", length)
            text = bytearray(length)
            process.fill(memoryview(text))
            yield f"{clip.name}.usda", [bytes(text)]
