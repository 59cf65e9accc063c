"""The door for what comes out: an upload and its segmentation in, a file of clips or of key poses out."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from mmap import mmap

from caesura.core.animation import Animation
from caesura.core.document import SegmentationDocument
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.clips.animation_replacement import Replacement
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import Clip, Stretch, plan
from caesura.formats.clips.clip_source import clip_source
from caesura.formats.clips.gltf_clips import gltf_clips, planned
from caesura.formats.clips.key_poses import gltf_key_poses, sequence_key_poses
from caesura.formats.clips.npz_clips import sequence_clips
from caesura.formats.clips.take_ranges import gltf_stretches
from caesura.formats.file_type import SNIFFED, sniff
from caesura.formats.read import main_part, read_animation
from caesura.formats.zip.stream_writer import zipped

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
    gltf, animation = _opened(parts, document, scratch)
    if animation is not None:
        start = animation.start_seconds
        last = start + (animation.frames - 1) / animation.frame_rate
        whole = Stretch(0, 0, animation.frames, start, last, last)
        return Written(ZIP, sequence_clips(animation, plan(document, options, [whole])))
    file = Replacement(gltf, animation_only=options.animation_only)
    made = planned(file, document, options)
    takes = {stretch.take for stretch in gltf_stretches(file, document)}
    if options.files == "one":
        return Written(GLB, gltf_clips(file, made, options, takes))

    source = clip_source(gltf)

    def alone(clip: Clip) -> Iterator[bytes]:
        yield from gltf_clips(Replacement(source, animation_only=options.animation_only), [clip], options, takes)

    return Written(ZIP, zipped(((f"{clip.name}.glb", alone(clip)) for clip in made), deflated=True))


def write_key_poses(parts: Parts, document: SegmentationDocument, scratch: Scratch) -> Written:
    """The key-frames as a GLB whose one animation steps from pose to pose; raises `no-key-frames`."""
    gltf, animation = _opened(parts, document, scratch)
    if animation is not None:
        return Written(GLB, sequence_key_poses(animation, document))
    return Written(GLB, gltf_key_poses(Replacement(gltf), document))


def _opened(
    parts: Parts, document: SegmentationDocument, scratch: Scratch
) -> tuple[Mapping[str, memoryview], Animation | None]:
    """The glTF that the upload is or is read as, by its parts; or else its vertices."""
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    if _is_gltf(views):
        return views, None
    animation = read_animation(views, Parameters.model_validate(document.parameters), Limits.none(), scratch)
    return ({}, animation) if animation.gltf is None else (animation.gltf, None)


def _is_gltf(views: dict[str, memoryview]) -> bool:
    try:
        return sniff(bytes(views[main_part(views)][:SNIFFED])) in {"glb", "gltf"}
    except InvalidModel:  # a mesh and its motion, in a file each
        return False
