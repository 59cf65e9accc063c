"""Writes the clips or the key poses of an upload and its segmentation."""

from collections.abc import Callable, Iterator, Mapping
from mmap import mmap

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import Clip, TakeFrames, plan_clips
from caesura.formats.clips.clip_source import clip_source
from caesura.formats.clips.gltf_clips import plan_gltf_clips, write_gltf_clips
from caesura.formats.clips.in_kind.animation_file import open_animation_file
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.clips.key_poses import write_gltf_key_poses, write_npz_key_poses
from caesura.formats.clips.take_ranges import gltf_take_ranges
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.read import find_main_part, read_animation
from caesura.formats.streamed_file import StreamedFile
from caesura.formats.zip.stream_writer import stream_zip

GLB, ZIP = "model/gltf-binary", "application/zip"

Parts = Mapping[str, bytes | memoryview | mmap]
Scratch = Callable[[int], memoryview]

UNLIMITED = Limits.none()
"""As on one's own machine."""


def write_clips(
    parts: Parts,
    document: SegmentationDocument,
    options: ClipOptions,
    scratch: Scratch,
    limits: Limits = UNLIMITED,
) -> StreamedFile:
    """The take as clips: a zip of files of the kind that was sent, or a GLB; with `files=separate` a zip of GLBs.

    Where the file is read again, it is within `limits`. Raises `ParameterError` where the options leave nothing, or
    name what there is not.
    """
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    model = open_animation_file(views, scratch) if options.form == "source" else None
    if model is not None:
        _check_stays_as_performed(options)
        clips = plan_clips(document, options, [_whole_take(document)])
        request = ClipRequest(model, clips, document, options, scratch, limits)
        return StreamedFile(ZIP, model.known.load(model.known.clips)(request))
    gltf, animation = _open_upload(parts, document, scratch, limits)
    if animation is not None:
        detail = "The file has vertices for every frame and nothing that moves them: its clips are not GLB."
        raise ParameterError("no-glb-clips", f"{detail} Send form=source.", parameter="form")
    file = AnimationReplacement(gltf, animation_only=options.animation_only)
    made = plan_gltf_clips(file, document, options)
    takes = {take_range.take for take_range in gltf_take_ranges(file, document)}
    if options.files == "one":
        return StreamedFile(GLB, write_gltf_clips(file, made, options, takes))

    source = clip_source(gltf)

    def alone(clip: Clip) -> Iterator[bytes]:
        yield from write_gltf_clips(
            AnimationReplacement(source, animation_only=options.animation_only), [clip], options, takes
        )

    return StreamedFile(ZIP, stream_zip(((f"{clip.name}.glb", alone(clip)) for clip in made), deflated=True))


def _check_stays_as_performed(options: ClipOptions) -> None:
    """Raise `ParameterError` where clips of the kind that was sent are to be changed."""
    for parameter, asked in (("loop_blend_seconds", options.loop_blend_seconds > 0), ("root", options.root != "keep")):
        if asked:
            detail = f"Clips of the kind of file that was sent keep the motion as it is: {parameter} needs GLB."
            raise ParameterError("invalid-parameter", f"{detail} Send form=glb too.", parameter=parameter)


def write_key_poses(
    parts: Parts, document: SegmentationDocument, scratch: Scratch, limits: Limits = UNLIMITED
) -> StreamedFile:
    """The key-frames as a GLB whose one animation steps from pose to pose; raises `no-key-frames`."""
    gltf, animation = _open_upload(parts, document, scratch, limits)
    if animation is not None:
        return StreamedFile(GLB, write_npz_key_poses(animation, document))
    return StreamedFile(GLB, write_gltf_key_poses(AnimationReplacement(gltf), document))


def _whole_take(document: SegmentationDocument) -> TakeFrames:
    start = document.source.start_seconds
    last = start + (document.frames - 1) / document.frame_rate
    return TakeFrames(0, 0, document.frames, start, last, last)


def _open_upload(
    parts: Parts, document: SegmentationDocument, scratch: Scratch, limits: Limits
) -> tuple[Mapping[str, memoryview], Animation | None]:
    """The glTF that the upload is or is read as, by its parts; or else its vertices."""
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    if _is_gltf(views):
        return views, None
    animation = read_animation(views, Parameters.model_validate(document.parameters), limits, scratch)
    return ({}, animation) if animation.gltf is None else (animation.gltf, None)


def _is_gltf(views: dict[str, memoryview]) -> bool:
    try:
        return detect_file_type(bytes(views[find_main_part(views)][:SIGNATURE_BYTES])) in {"glb", "gltf"}
    except InvalidModel:  # a mesh and its motion, in a file each
        return False
