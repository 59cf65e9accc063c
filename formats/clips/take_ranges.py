"""Which frames of a result are of which take: of the one that was cut, or of all of them, one after the other."""

from caesura.core.document import SegmentationDocument
from caesura.core.parameters import Parameters
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.clip_plan import TakeRange
from caesura.formats.frame_rate import count_frames
from caesura.formats.gltf.animation.channels import read_channels
from caesura.formats.gltf.animation.take import last_key_seconds

ALL = -1
"""The number of the take that is all takes."""


def gltf_take_ranges(file: AnimationReplacement, document: SegmentationDocument) -> list[TakeRange]:
    """One for each take that was drawn."""
    parameters = Parameters.model_validate(document.parameters)
    if document.source.take != ALL:
        return [_one(file, document, parameters)]
    rate, stretches = document.frame_rate, []
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
            stretches.append(TakeRange(take, first, end, start, until, duration))
        film += frames
    return stretches


def _one(file: AnimationReplacement, document: SegmentationDocument, parameters: Parameters) -> TakeRange:
    take = document.source.take
    channels = read_channels(file.document, file.accessors, file.document.animations[take])
    duration, start = last_key_seconds(file.accessors, channels), document.source.start_seconds
    last = start + (document.frames - 1) / document.frame_rate
    until = max(duration, last) if parameters.end == "last" else last
    return TakeRange(take, 0, document.frames, start, until, max(duration, last))


def first_key_seconds(file: AnimationReplacement, take: int) -> float:
    """Seconds of the first key of a take."""
    channels = read_channels(file.document, file.accessors, file.document.animations[take])
    inputs = {channel.input.index: channel.input for channel in channels}
    return min(float(file.accessors.floats(layout)[0, 0]) for layout in inputs.values())
