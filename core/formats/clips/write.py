"""The door for what comes out: an upload and its segmentation in, a file of clips or of key poses out."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from mmap import mmap

from core.animation import Animation
from core.document import SegmentationDocument
from core.formats.clips.gltf_clips import gltf_clips, planned
from core.formats.clips.key_poses import gltf_key_poses, sequence_key_poses
from core.formats.clips.options import ClipOptions
from core.formats.clips.plan import plan
from core.formats.clips.replacement import Replacement
from core.formats.clips.sequence_clips import sequence_clips
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
    if _is_sequence(views):
        animation = _sequence(views, document, scratch)
        clips = plan(document, options, (animation.frames - 1) / animation.frame_rate)
        return Written(ZIP, sequence_clips(animation, clips))
    file = Replacement(views, animation_only=options.animation_only)
    gltf = planned(file, document, options)
    take = document.source.take
    if options.files == "one":
        return Written(GLB, gltf_clips(file, take, gltf, options))
    each = (
        (
            f"{clip.name}.glb",
            gltf_clips(Replacement(views, animation_only=options.animation_only), take, [clip], options),
        )
        for clip in gltf
    )
    return Written(ZIP, zipped(each, deflated=True))


def write_key_poses(parts: Parts, document: SegmentationDocument, scratch: Scratch) -> Written:
    """The key-frames as a GLB whose one animation steps from pose to pose; raises `no-key-frames`."""
    views = _views(parts)
    if _is_sequence(views):
        return Written(GLB, sequence_key_poses(_sequence(views, document, scratch), document))
    return Written(GLB, gltf_key_poses(Replacement(views), document))


def _views(parts: Parts) -> dict[str, memoryview]:
    return {name: memoryview(part).toreadonly() for name, part in parts.items()}


def _is_sequence(views: dict[str, memoryview]) -> bool:
    return sniff(bytes(views[main_part(views)][:SNIFFED])) == "npz"


def _sequence(views: dict[str, memoryview], document: SegmentationDocument, scratch: Scratch) -> Animation:
    return read_animation(views, Parameters.model_validate(document.parameters), Limits.none(), scratch)
