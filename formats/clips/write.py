"""The door for what comes out: an upload and its segmentation in, a file of clips or of key poses out."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from mmap import mmap

from caesura.core.animation import Animation
from caesura.core.document import SegmentationDocument
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import Clip, TakeRange, plan_clips
from caesura.formats.clips.clip_source import clip_source
from caesura.formats.clips.gltf_clips import plan_gltf_clips, write_gltf_clips
from caesura.formats.clips.key_poses import write_gltf_key_poses, write_npz_key_poses
from caesura.formats.clips.npz_clips import write_npz_clips
from caesura.formats.clips.take_ranges import gltf_take_ranges
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.read import find_main_part, read_animation
from caesura.formats.zip.stream_writer import stream_zip

GLB, ZIP = "model/gltf-binary", "application/zip"

Parts = Mapping[str, bytes | memoryview | mmap]
Scratch = Callable[[int], memoryview]


@dataclass(frozen=True)
class WrittenFile:
    """A file: its media type, and its content, to be read once, while the upload is still there."""

    media_type: str
    pieces: Iterator[bytes]


def write_clips(parts: Parts, document: SegmentationDocument, options: ClipOptions, scratch: Scratch) -> WrittenFile:
    """The take as clips: a GLB of a glTF, a zip of a vertex sequence or of `files=separate`.

    Raises `ParameterError` where the options leave nothing, or name what there is not.
    """
    gltf, animation = _opened(parts, document, scratch)
    if animation is not None:
        start = animation.start_seconds
        last = start + (animation.frames - 1) / animation.frame_rate
        whole = TakeRange(0, 0, animation.frames, start, last, last)
        return WrittenFile(ZIP, write_npz_clips(animation, plan_clips(document, options, [whole])))
    file = AnimationReplacement(gltf, animation_only=options.animation_only)
    made = plan_gltf_clips(file, document, options)
    takes = {stretch.take for stretch in gltf_take_ranges(file, document)}
    if options.files == "one":
        return WrittenFile(GLB, write_gltf_clips(file, made, options, takes))

    source = clip_source(gltf)

    def alone(clip: Clip) -> Iterator[bytes]:
        yield from write_gltf_clips(
            AnimationReplacement(source, animation_only=options.animation_only), [clip], options, takes
        )

    return WrittenFile(ZIP, stream_zip(((f"{clip.name}.glb", alone(clip)) for clip in made), deflated=True))


def write_key_poses(parts: Parts, document: SegmentationDocument, scratch: Scratch) -> WrittenFile:
    """The key-frames as a GLB whose one animation steps from pose to pose; raises `no-key-frames`."""
    gltf, animation = _opened(parts, document, scratch)
    if animation is not None:
        return WrittenFile(GLB, write_npz_key_poses(animation, document))
    return WrittenFile(GLB, write_gltf_key_poses(AnimationReplacement(gltf), document))


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
        return detect_file_type(bytes(views[find_main_part(views)][:SIGNATURE_BYTES])) in {"glb", "gltf"}
    except InvalidModel:  # a mesh and its motion, in a file each
        return False
