"""`caesura segment`: find the motions of files on this machine, without a server."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from core.document import SegmentationDocument
from core.errors import CaesuraError
from core.formats.clips.options import ClipOptions
from core.limits import Limits
from core.parameters import Parameters
from service.commands import options
from service.commands.buffers import mapped, scratch
from service.commands.problems import Command, show
from service.commands.progress_bar import ProgressBar
from service.commands.table import table

OUT = click.Path(dir_okay=False, writable=True, path_type=Path)


@click.command(cls=Command)
@click.argument(
    "files", metavar="FILE...", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False, path_type=Path)
)
@options.parameters
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document, one line for each file.")
@click.option("--clips", type=OUT, help="Write the file again with its motions as clips: a GLB, or a zip.")
@click.option("--keyframes", type=OUT, help="Write the file again with its key poses alone, as a GLB.")
@options.clips
@click.option("--threads", type=click.IntRange(1), help="Threads to compute with.  [default: what this machine gives]")
@click.pass_context
def segment(
    context: click.Context,
    /,
    files: tuple[Path, ...],
    as_json: bool,
    threads: int | None,
    clips: Path | None,
    keyframes: Path | None,
    **given: Any,
) -> None:
    """Find the motions in each FILE: a GLB, a glTF or an NPZ.

    A .bin among the files is no animation of its own: it is offered to every glTF that names it. With several
    files a bad one does not stop the others; with --json its line is null.
    """
    parameters, chosen = Parameters.parse(options.given(given)), options.clip_options(given)
    companions = [path for path in files if path.suffix.lower() == ".bin"]
    animations = [path for path in files if path not in companions] or companions
    if len(animations) > 1 and (clips or keyframes):
        raise click.UsageError("--clips and --keyframes name one file: give one animation at a time.")
    failed = 0
    for path in animations:
        try:
            parts = {p.name: mapped(p) for p in [path, *(c for c in companions if c != path)]}
            found = _found(parts, parameters, threads)
            _write(parts, found, chosen, clips, keyframes)
        except CaesuraError as refused:
            failed = failed or show(refused.problem(), as_json=as_json, file=str(path))
            if as_json and len(animations) > 1:
                click.echo("null")
            continue
        click.echo(found.model_dump_json() if as_json else table(path.name, found))
    context.exit(failed)


def _found(parts: Mapping[str, memoryview], parameters: Parameters, threads: int | None) -> SegmentationDocument:
    """Read, analyse and cut one animation. What is heavy is imported here, and what computes only for a good file."""
    from core.formats.read import read_animation

    with ProgressBar() as progress:
        progress("reading", 0.0)
        animation = read_animation(parts, parameters, Limits.none(), scratch)

        from core.pipeline import segment as motions_of
        from worker.cpu import available_threads

        return motions_of(animation, parameters, threads=threads or available_threads(), progress=progress).document()


def _write(
    parts: Mapping[str, memoryview],
    found: SegmentationDocument,
    chosen: ClipOptions,
    clips: Path | None,
    keyframes: Path | None,
) -> None:
    """The files that were asked for, made of the one that was read."""
    if not clips and not keyframes:
        return
    from core.formats.clips.write import write_clips, write_key_poses

    if clips:
        _save(clips, write_clips(parts, found, chosen, scratch).pieces)
    if keyframes:
        _save(keyframes, write_key_poses(parts, found, scratch).pieces)


def _save(path: Path, pieces: Iterator[bytes]) -> None:
    """Write it aside, then to its name: it is whole or not there, and may replace the file that it is made of."""
    aside = path.with_name(f".{path.name}.part")
    try:
        with aside.open("wb") as file:
            file.writelines(pieces)
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)
