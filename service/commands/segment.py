"""`caesura segment`: find the motions of files on this machine, without a server."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from caesura.core.document import SegmentationDocument
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.service.commands import options
from caesura.service.commands.batch import Batch
from caesura.service.commands.buffers import map_file, scratch_buffer
from caesura.service.commands.files import ExistingFiles, output_paths
from caesura.service.commands.outputs import Outputs, output_option_decorators
from caesura.service.commands.problems import Command, print_problem
from caesura.service.commands.progress_bar import ProgressBar
from caesura.service.commands.table import print_table

FOLDER = click.Path(file_okay=False, path_type=Path)


@click.command(cls=Command)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=ExistingFiles())
@click.option("--out", metavar="DIR", type=FOLDER, help="Write NAME.json for every FILE, and print a table at the end.")
@output_option_decorators
@options.parameter_option_decorators
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document, one line for each file.")
@options.clip_option_decorators
@click.option("--threads", type=click.IntRange(1), help="Threads to compute with.  [default: what this machine gives]")
@click.pass_context
def segment(
    context: click.Context,
    /,
    files: tuple[tuple[Path, ...], ...],
    out: Path | None,
    as_json: bool,
    threads: int | None,
    **given: Any,
) -> None:
    """Find the motions in each FILE: a GLB, a glTF, a BVH, an NPZ, or a zip; patterns such as "*.glb" are fine.

    A .bin among the files is no animation of its own: it is offered to every glTF that names it. With several
    files a bad one does not stop the others; with --json its line is null. The exit code is that of the first
    that was bad: 0 where none was.

    With --out, --clips, --csv and the like need no name: each file's results are named after it.
    """
    parameters, chosen = Parameters.parse(options.given_parameters(given)), options.clip_options(given)
    paths = list(dict.fromkeys(path for found in files for path in found))
    companions = [path for path in paths if path.suffix.lower() == ".bin"]
    animations = [path for path in paths if path not in companions] or companions
    written = Outputs.of(given, chosen, animations, companions, out)
    batch = Batch()
    for path, target in zip(animations, _targets(animations, out), strict=True):
        with batch.file(path) as outcome:
            parts = {p.name: map_file(p) for p in [path, *(c for c in companions if c != path)]}
            found = _found(parts, parameters, threads)
            written.write(parts, found, target)
            outcome.found = found
            if as_json or out is None:
                click.echo(found.model_dump_json() if as_json else print_table(path.name, found))
        if outcome.problem:
            print_problem(outcome.problem, as_json=as_json, file=str(path))
            if as_json and len(animations) > 1:
                click.echo("null")
    if out is not None and not as_json:
        click.echo(batch.table())
    context.exit(batch.exit_code())


def _targets(animations: list[Path], out: Path | None) -> list[Path] | list[None]:
    return [None] * len(animations) if out is None else output_paths(animations, out)


def _found(parts: Mapping[str, memoryview], parameters: Parameters, threads: int | None) -> SegmentationDocument:
    """Read, analyse and cut one animation. What is heavy is imported here, and what computes only for a good file."""
    from caesura.formats.read import read_animation

    with ProgressBar() as progress:
        progress("reading", 0.0)
        animation = read_animation(parts, parameters, Limits.none(), scratch_buffer)

        from caesura.core.pipeline import segment as motions_of
        from caesura.worker.process.thread_count import available_threads

        return motions_of(animation, parameters, threads=threads or available_threads(), progress=progress).document()
