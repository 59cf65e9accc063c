"""Clips of a glTF: the take cut channel by channel, clip by clip."""

from collections.abc import Iterator, Sequence

from core.document import SegmentationDocument
from core.formats.clips.channels import TakeChannel, Tracks, take_channels
from core.formats.clips.cutting import Part, cut, spanning
from core.formats.clips.options import ClipOptions
from core.formats.clips.plan import Clip, plan
from core.formats.clips.replacement import Replacement
from core.formats.gltf.channels import read_channels
from core.formats.gltf.take import last_key, take_names


def planned(file: Replacement, document: SegmentationDocument, options: ClipOptions) -> tuple[Clip, ...]:
    """The clips of the document's take, with names that no animation has which stays beside them."""
    take = document.source.take
    channels = read_channels(file.document, file.accessors, file.document.animations[take])
    staying = [
        name
        for number, name in enumerate(take_names(file.document))
        if options.files == "one" and not options.animation_only and (options.keep_source or number != take)
    ]
    return plan(document, options, last_key(file.accessors, channels), staying)


def gltf_clips(file: Replacement, take: int, clips: Sequence[Clip], options: ClipOptions) -> Iterator[bytes]:
    """The GLB, piece by piece."""
    everything = options.animation_only or options.files == "separate"
    kept_take = options.keep_source and not everything
    removed = list(range(len(file.document.animations))) if everything else [take] * (not kept_take)
    file.remove(removed, take)
    tracks = [Tracks() for _ in clips]
    reaching = [False] * len(clips)
    first: TakeChannel | None = None
    for channel in take_channels(file, take, nodes_only=options.animation_only):
        first = first or channel
        for number, clip in enumerate(clips):
            part = cut(channel.keys, clip.start, clip.end, _origin(clip, options))
            reaching[number] |= not part.is_still
            tracks[number].add(channel.target, _sampler(file, channel, part))
    for number, clip in enumerate(clips):
        if first is not None and not reaching[number]:
            _reach(file, tracks[number], first, clip, options)
    source = file.document.animations[take].value
    file.add([track.animation(clip.name, source, clip.extras) for track, clip in zip(tracks, clips, strict=True)])
    return file.pieces()


def _reach(file: Replacement, tracks: Tracks, channel: TakeChannel, clip: Clip, options: ClipOptions) -> None:
    """Give a clip in which nothing moves its length all the same: by its first channel."""
    origin = _origin(clip, options)
    part = spanning(cut(channel.keys, clip.start, clip.end, origin), clip.start, clip.end, origin)
    tracks.samplers.append(_sampler(file, channel, part))
    tracks.channels[0] = {**tracks.channels[0], "sampler": len(tracks.samplers) - 1}


def _origin(clip: Clip, options: ClipOptions) -> float:
    return clip.start if options.origin == "start" else 0.0


def _sampler(file: Replacement, channel: TakeChannel, part: Part) -> dict[str, object]:
    """Its keys in the file: those of the take where they lie, else new ones."""
    output, keys = None, channel.keys
    layout = channel.output
    elements = keys.stored[0].size // layout.width
    if part.window is not None:
        output = file.window(layout, part.window[0] * elements, part.window[1] * elements)
    if output is None:
        stored_as_integers = layout.normalized and part.values.dtype.kind != "f"
        more = {"normalized": True} if stored_as_integers else {}
        output = file.array(part.values, layout.type, layout.width, more)
    named = {} if keys.interpolation == "LINEAR" else {"interpolation": keys.interpolation}
    return {"input": file.times(part.times), "output": output, **named, **channel.more}
