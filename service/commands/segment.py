"""`caesura segment`: find the motions of files on this machine, without a server."""

from pathlib import Path
from typing import Any

import click

from caesura.core.parameters import Parameters
from caesura.formats.input_formats import COMPANION_SUFFIXES, READABLE_FORMATS
from caesura.service.commands import options
from caesura.service.commands.batch import Batch
from caesura.service.commands.exit_codes import INTERRUPTED, TERMINATED, Command, leave_broken_pipe, print_problem
from caesura.service.commands.file_arguments import STANDARD, ExistingFiles, output_paths
from caesura.service.commands.file_segmentation import FileOutcome, FileTask
from caesura.service.commands.joint.motion_names import parse_names
from caesura.service.commands.joint.segmentation import segment_files_together
from caesura.service.commands.output_files import Outputs, output_option_decorators
from caesura.service.commands.terminal.segment_table import print_table
from caesura.service.commands.termination import Terminated, termination_as_interrupt

FOLDER = click.Path(file_okay=False, path_type=Path)


@click.command(
    cls=Command,
    short_help="Find the motions in files, on this machine.",
    epilog=f"Formats of files: {READABLE_FORMATS}.",
)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=ExistingFiles())
@click.option("--out", metavar="DIR", type=FOLDER, help="Write NAME.json for every FILE, and print a table at the end.")
@output_option_decorators
@options.parameter_option_decorators
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document, one line for each file.")
@click.option("--together", is_flag=True, help="One set of motions over all files, of one body.  [with --out]")
@click.option("--name", "named", metavar="OLD=NEW", multiple=True, help="Call a motion so.  [of --together]")
@options.clip_option_decorators
@click.option("--force", is_flag=True, help="Write over a FILE or another animation where an output is called so.")
@click.option("--jobs", type=click.IntRange(1), default=1, show_default=True, help="Files at once, each in a process.")
@click.option("--threads", type=click.IntRange(1), help="Threads for each file.  [default: what this machine gives]")
@click.pass_context
def segment(
    context: click.Context,
    /,
    files: tuple[tuple[Path, ...], ...],
    out: Path | None,
    as_json: bool,
    together: bool,
    named: tuple[str, ...],
    force: bool,
    jobs: int,
    threads: int | None,
    **given: Any,
) -> None:
    """Find the motions in each FILE: its format is told by its first bytes; patterns such as "*.glb" are fine.

    A .bin, .obj or .asf among the files is no animation of its own: it is offered to every file that needs one. With
    several files a bad one does not stop the others; with --json its line is null. The exit code is that of the first
    that was bad: 0 where none was.

    With --together, the files are takes of one body, and a motion has the same name in all of them. --motions is the
    number of motions of all; motions.csv and motions.json in --out hold the segments of all, and clips are called
    after motion and file. --name A=walk names a motion, and caesura rename does it later.

    With --out, --clips, --csv and the like need no name: each file's results are named after it. As a FILE, or as the
    name of an output, - is standard input or output.
    """
    parameters, chosen = Parameters.parse(options.given_parameters(given)), options.given_clip_options(given)
    paths = list(dict.fromkeys(path for found in files for path in found))
    companions = [path for path in paths if path.suffix.lower() in COMPANION_SUFFIXES]
    animations = [path for path in paths if path not in companions] or companions
    if STANDARD in animations and len(animations) > 1:
        raise click.UsageError("- is standard input, which is one animation: give it without others.")
    targets: list[Path | None] = [None] * len(animations) if out is None else [*output_paths(animations, out)]
    outputs = Outputs.of(given, chosen, animations, companions, targets, force=force)
    if as_json and outputs.to_standard_output:
        raise click.UsageError("--json and an output that is - would both go to standard output: name a file.")
    if jobs > 1 and threads is None:
        threads = _threads_for_each(min(jobs, len(animations)))
    tasks = [
        FileTask(path, tuple(companions), parameters, outputs, target, threads)
        for path, target in zip(animations, targets, strict=True)
    ]
    names = parse_names(named)
    if together:
        context.exit(segment_files_together(tasks, out, names, as_json=as_json))
    if names:
        raise click.UsageError("--name says how common motions are called: it needs --together beside it.")
    batch, quiet = Batch(tasks), out is not None or outputs.to_standard_output
    try:
        with termination_as_interrupt():
            for outcome in batch.run(jobs if len(tasks) > 1 else 1):
                _print_outcome(outcome, as_json=as_json, quiet=quiet, of_several=len(tasks) > 1)
    except BrokenPipeError:
        context.exit(leave_broken_pipe())
    except KeyboardInterrupt as told:
        click.echo(f"caesura: interrupted; {batch.how_many()}", err=True)
        context.exit(TERMINATED if isinstance(told, Terminated) else INTERRUPTED)
    if out is not None and not as_json:
        click.echo(batch.table())
    context.exit(batch.exit_code())


def _threads_for_each(jobs: int) -> int:
    from caesura.worker.process.thread_count import available_threads

    return max(available_threads() // jobs, 1)


def _print_outcome(outcome: FileOutcome, *, as_json: bool, quiet: bool, of_several: bool) -> None:
    """The document or the table, unless it is in a folder or in the way; and what was wrong."""
    if outcome.found is not None and (as_json or not quiet):
        shown = outcome.found.model_dump_json() if as_json else print_table(outcome.path.name, outcome.found)
        click.echo(shown)
    if outcome.problem:
        print_problem(outcome.problem, as_json=as_json, file=str(outcome.path))
        if as_json and of_several:
            click.echo("null")
