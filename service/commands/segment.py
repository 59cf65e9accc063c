"""`caesura segment`: find the motions of files on this machine, without a server."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from core.document import SegmentationDocument
from core.errors import CaesuraError
from core.limits import Limits
from core.parameters import Parameters
from service.commands import options
from service.commands.buffers import mapped, scratch
from service.commands.problems import Command, show
from service.commands.progress_bar import ProgressBar
from service.commands.table import table


@click.command(cls=Command)
@click.argument(
    "files", metavar="FILE...", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False, path_type=Path)
)
@options.parameters
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document, one line for each file.")
@click.option("--threads", type=click.IntRange(1), help="Threads to compute with.  [default: what this machine gives]")
@click.pass_context
def segment(
    context: click.Context, /, files: tuple[Path, ...], as_json: bool, threads: int | None, **given: Any
) -> None:
    """Find the motions in each FILE: a GLB, a glTF or an NPZ.

    A .bin among the files is no animation of its own: it is offered to every glTF that names it. With several
    files a bad one does not stop the others; with --json its line is null.
    """
    parameters = Parameters.parse(options.given(given))
    companions = [path for path in files if path.suffix.lower() == ".bin"]
    animations = [path for path in files if path not in companions] or companions
    failed = 0
    for path in animations:
        try:
            found = _found([path, *(c for c in companions if c != path)], parameters, threads)
        except CaesuraError as refused:
            failed = failed or show(refused.problem(), as_json=as_json, file=str(path))
            if as_json and len(animations) > 1:
                click.echo("null")
            continue
        click.echo(found.model_dump_json() if as_json else table(path.name, found))
    context.exit(failed)


def _found(paths: Sequence[Path], parameters: Parameters, threads: int | None) -> SegmentationDocument:
    """Read, analyse and cut one animation. What is heavy is imported here, and what computes only for a good file."""
    from core.formats.read import read_animation

    with ProgressBar() as progress:
        progress("reading", 0.0)
        parts = {path.name: mapped(path) for path in paths}
        animation = read_animation(parts, parameters, Limits.none(), scratch)

        from core.pipeline import segment as motions_of
        from worker.cpu import available_threads

        return motions_of(animation, parameters, threads=threads or available_threads(), progress=progress).document()
