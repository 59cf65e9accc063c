"""The door for what comes out: an upload and its segmentation in, a file of clips or of key poses out."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from mmap import mmap

from core.animation import Animation
from core.document import SegmentationDocument
from core.formats.bvh.as_gltf import bvh_as_gltf
from core.formats.clips.gltf_clips import gltf_clips, planned
from core.formats.clips.key_poses import gltf_key_poses, sequence_key_poses
from core.formats.clips.options import ClipOptions
from core.formats.clips.plan import Clip, Stretch, plan
from core.formats.clips.replacement import Replacement
from core.formats.clips.sequence_clips import sequence_clips
from core.formats.clips.stretches import gltf_stretches
from core.formats.clips.zip_stream import zipped
from core.formats.read import main_part, read_animation
from core.formats.sniffing import SNIFFED, sniff
from core.limits import Limits
from core.parameters import Parameters

GLB, ZIP = "model/gltf-binary", "application/zip"

Parts = Mapping[str, bytes | memoryview | mmap]
Scratch = Callable[[int], memoryview]


@dataclass(frozen=True)
class Written:
    """A file: its media type, and its content, to be read once, while the upload is still there."""

    media_type: str
    pieces: Iterator[bytes]


def write_clips(parts: Parts, document: SegmentationDocument, options: ClipOptions, scratch: Scratch) -> Written:
    """The take as clips: a GLB of a glTF, a zip of a vertex sequence or of `files=separate`.

    Raises `ParameterError` where the options leave nothing, or name what there is not.
    """
    views = _views(parts)
    gltf = _gltf(views)
    if gltf is None:
        animation = _sequence(views, document, scratch)
        start = animation.start_seconds
        last = start + (animation.frames - 1) / animation.frame_rate
        whole = Stretch(0, 0, animation.frames, start, last, last)
        return Written(ZIP, sequence_clips(animation, plan(document, options, [whole])))
    file = Replacement(gltf, animation_only=options.animation_only)
    made = planned(file, document, options)
    takes = {stretch.take for stretch in gltf_stretches(file, document)}
    if options.files == "one":
        return Written(GLB, gltf_clips(file, made, options, takes))

    def alone(clip: Clip) -> Iterator[bytes]:
        yield from gltf_clips(Replacement(gltf, animation_only=options.animation_only), [clip], options, takes)

    return Written(ZIP, zipped(((f"{clip.name}.glb", alone(clip)) for clip in made), deflated=True))


def write_key_poses(parts: Parts, document: SegmentationDocument, scratch: Scratch) -> Written:
    """The key-frames as a GLB whose one animation steps from pose to pose; raises `no-key-frames`."""
    views = _views(parts)
    gltf = _gltf(views)
    if gltf is None:
        return Written(GLB, sequence_key_poses(_sequence(views, document, scratch), document))
    return Written(GLB, gltf_key_poses(Replacement(gltf), document))


def _views(parts: Parts) -> dict[str, memoryview]:
    return {name: memoryview(part).toreadonly() for name, part in parts.items()}


def _gltf(views: dict[str, memoryview]) -> dict[str, memoryview] | None:
    """The upload where it is a glTF, or what is read as one; None where it is vertices."""
    data = views[main_part(views)]
    kind = sniff(bytes(data[:SNIFFED]))
    if kind == "bvh":
        return {"motion.glb": memoryview(bvh_as_gltf(data, Limits.none()))}
    return views if kind in {"glb", "gltf"} else None


def _sequence(views: dict[str, memoryview], document: SegmentationDocument, scratch: Scratch) -> Animation:
    return read_animation(views, Parameters.model_validate(document.parameters), Limits.none(), scratch)
