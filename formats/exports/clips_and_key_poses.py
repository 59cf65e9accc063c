"""The uploaded file again: with its motions as clips, or with its key poses alone."""

from caesura.formats.clips.write_clips import write_clips, write_key_poses
from caesura.formats.exports.table import ExportSource
from caesura.formats.written_file import WrittenFile


def clips(source: ExportSource) -> WrittenFile:
    """The upload with its take in clips."""
    return write_clips(source.parts, source.document, source.options, source.scratch)


def key_poses(source: ExportSource) -> WrittenFile:
    """The upload with its take reduced to key poses."""
    return write_key_poses(source.parts, source.document, source.scratch)
