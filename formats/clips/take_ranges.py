"""The frames of a result that belong to each take."""

from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.clip_plan import TakeFrames
from caesura.formats.gltf.animation.channels import read_channels
from caesura.formats.gltf.animation.take_choice import last_key_seconds
from caesura.formats.takes.frame_rate import count_frames

ALL = -1
"""The number of the take that is all takes."""


def gltf_take_ranges(file: AnimationReplacement, document: SegmentationDocument) -> list[TakeFrames]:
    """One for each take that was drawn."""
    parameters = Parameters.model_validate(document.parameters)
    if document.source.take != ALL:
        return [_take_range(file, document, parameters)]
    rate, take_ranges = document.frame_rate, []
    film = -round(document.source.start_seconds * rate)  # where the take begins among the frames that were drawn
    for take in range(len(file.document.animations)):
        channels = read_channels(file.document, file.accessors, file.document.animations[take])
        if not channels:
            continue
        duration = last_key_seconds(file.accessors, channels)
        origin = first_key_seconds(file, take) if parameters.trim else 0.0
        frames = int(count_frames(duration - origin, rate))
        first, end = max(film, 0), min(film + frames, document.frames)
        start = origin + (first - film) / rate
        if first < end:
            until = duration if end == film + frames else start + (end - 1 - first) / rate
            take_ranges.append(TakeFrames(take, first, end, start, until, duration))
        film += frames
    return take_ranges


def _take_range(file: AnimationReplacement, document: SegmentationDocument, parameters: Parameters) -> TakeFrames:
    take = document.source.take
    channels = read_channels(file.document, file.accessors, file.document.animations[take])
    duration, start = last_key_seconds(file.accessors, channels), document.source.start_seconds
    last = start + (document.frames - 1) / document.frame_rate
    until = max(duration, last) if parameters.end == "last" else last
    return TakeFrames(take, 0, document.frames, start, until, max(duration, last))


def first_key_seconds(file: AnimationReplacement, take: int) -> float:
    """Seconds of the first key of a take."""
    channels = read_channels(file.document, file.accessors, file.document.animations[take])
    inputs = {channel.input.index: channel.input for channel in channels}
    return min(float(file.accessors.floats(layout)[0, 0]) for layout in inputs.values())
