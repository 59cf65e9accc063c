"""Clips of a glTF: each take cut channel by channel, clip by clip."""

from collections.abc import Iterator, Sequence

from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.channel_cut import ChannelPart, cut_channel, extend_to_clip, value_of_single_key
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import Clip, plan_clips
from caesura.formats.clips.clip_source import drop_large_extras
from caesura.formats.clips.loop_channel import LoopClosing, loop_channel
from caesura.formats.clips.take_channels import ClipTracks, TakeChannel, take_channels
from caesura.formats.clips.take_ranges import gltf_take_ranges


def plan_gltf_clips(
    file: AnimationReplacement, document: SegmentationDocument, options: ClipOptions
) -> tuple[Clip, ...]:
    """The clips of the document, with names that no animation has which stays beside them."""
    take_ranges = gltf_take_ranges(file, document)
    replaced = {take_range.take for take_range in take_ranges} if not options.keep_source else set()
    beside = options.files == "one" and not options.animation_only
    staying = [n for number, n in enumerate(file.document.take_names) if beside and number not in replaced]
    return plan_clips(document, options, take_ranges, staying)


def write_gltf_clips(
    file: AnimationReplacement, clips: Sequence[Clip], options: ClipOptions, cut_takes: set[int]
) -> Iterator[bytes]:
    """The GLB, piece by piece; clips take the places of the takes that they are of."""
    alone = options.animation_only or options.files == "separate"
    everything = set(range(len(file.document.animations)))
    file.remove(everything if alone else set() if options.keep_source else cut_takes)
    for take in sorted({clip.take for clip in clips}):
        _add_clip(file, take, [clip for clip in clips if clip.take == take], options)
    return file.pieces()


def _add_clip(file: AnimationReplacement, take: int, clips: list[Clip], options: ClipOptions) -> None:
    """The clips of one take."""
    drop_large_extras(file.document.animations[take].value)
    tracks = [ClipTracks() for _ in clips]
    reaching = [False] * len(clips)
    first: TakeChannel | None = None
    closing = LoopClosing.of(file, take, options) if any(clip.loops for clip in clips) else None
    for channel in take_channels(file, take, nodes_only=options.animation_only):
        first = first or channel
        for number, clip in enumerate(clips):
            part = _clip_part(channel, clip, _clip_origin(clip, options), closing)
            reaching[number] |= not part.is_still
            tracks[number].add(channel.target, _sampler(file, channel, part))
    for number, clip in enumerate(clips):
        if first is not None and not reaching[number]:
            _hold_full_length(file, tracks[number], first, clip, options)
    source = file.document.animations[take].value
    file.add(take, [t.animation(clip.name, source, clip.extras) for t, clip in zip(tracks, clips, strict=True)])


def _clip_part(channel: TakeChannel, clip: Clip, origin: float, closing: LoopClosing | None) -> ChannelPart:
    """The channel's keys in a clip; of one that loops as `closing` has them."""
    if closing is not None and clip.loops and clip.end > clip.start:
        closed = loop_channel(channel.keys, channel.target, (clip.start, clip.end), origin, closing)
        if closed is not None:
            return closed
    return cut_channel(channel.keys, clip.start, clip.end, origin)


def _hold_full_length(
    file: AnimationReplacement, tracks: ClipTracks, channel: TakeChannel, clip: Clip, options: ClipOptions
) -> None:
    """Give a clip in which nothing moves its length all the same: by its first channel."""
    origin = _clip_origin(clip, options)
    part = extend_to_clip(cut_channel(channel.keys, clip.start, clip.end, origin), clip.start, clip.end, origin)
    if part.is_still:
        return
    tracks.samplers.append(_sampler(file, channel, part))
    tracks.channels[0] = {**tracks.channels[0], "sampler": len(tracks.samplers) - 1}


def _clip_origin(clip: Clip, options: ClipOptions) -> float:
    return clip.start if options.origin == "start" else 0.0


def _sampler(file: AnimationReplacement, channel: TakeChannel, part: ChannelPart) -> dict[str, object]:
    """Its keys in the file: those of the take where they lie, else new ones."""
    output, keys = None, channel.keys
    layout, interpolation = channel.output, "LINEAR" if part.linear else keys.interpolation
    if interpolation == "CUBICSPLINE" and part.is_still:  # a spline must have two keys
        part, interpolation = value_of_single_key(keys, part), "STEP"
    elements = keys.stored[0].size // layout.width
    if part.window is not None:
        output = file.window(layout, part.window[0] * elements, part.window[1] * elements)
    if output is None:
        stored_as_integers = layout.normalized and part.values.dtype.kind != "f"
        more = {"normalized": True} if stored_as_integers else {}
        output = file.array(part.values, layout.type, layout.width, more)
    named = {} if interpolation == "LINEAR" else {"interpolation": interpolation}
    return {"input": file.times(part.times), "output": output, **named, **channel.sampler_extras}
