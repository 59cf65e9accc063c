"""The uploaded file again: with its motions as clips, or with its key poses alone."""

from caesura.formats.clips.write_clips import write_clips, write_key_poses
from caesura.formats.exports.export_table import ExportSource
from caesura.formats.streamed_file import StreamedFile


def clips(source: ExportSource) -> StreamedFile:
    """The upload with its take in clips."""
    return write_clips(source.parts, source.document, source.options, source.scratch, source.limits)


def key_poses(source: ExportSource) -> StreamedFile:
    """The upload with its take reduced to key poses."""
    return write_key_poses(source.parts, source.document, source.scratch, source.limits)
