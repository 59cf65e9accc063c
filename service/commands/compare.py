"""`caesura compare`: the methods side by side on labelled takes."""

import json
from pathlib import Path
from typing import Any

import click

from caesura.core.errors import CaesuraError, ParameterError
from caesura.core.parameters import Parameters
from caesura.core.registry.methods import METHODS
from caesura.service.commands import options
from caesura.service.commands.comparison.labelled_takes import find_labelled_takes
from caesura.service.commands.exit_codes import Command, exit_code, print_problem

ALL = "all"


@click.command(cls=Command, short_help="Compare the methods on labelled takes.")
@click.argument("takes", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
@click.option("--methods", default=ALL, show_default=True, help=f"Which, and commas: {', '.join(METHODS)}; or `{ALL}`.")
@click.option("--tier", help="The tier of an EAF.  [default: the first with annotations]")
@click.option("--each", is_flag=True, help="Print every take too, not the means alone.")
@click.option("--json", "as_json", is_flag=True, help="Print the figures of every take and method as JSON.")
@click.option("--threads", type=click.IntRange(1), help="Threads for each take.  [default: what this machine gives]")
@options.parameter_options_without("method", "motions", "expect", "details")
def compare(
    takes: tuple[Path, ...],
    methods: str,
    tier: str | None,
    each: bool,
    as_json: bool,
    threads: int | None,
    **given: Any,
) -> None:
    """Print what every method makes of TAKES: folders or files with labels beside them.

    \b
    The labels of FILE.glb are FILE.truth.json, FILE.json, FILE.csv or FILE.eaf,
    in the forms that `caesura score` reads. Formats are those of `caesura segment`.

    Accuracy is the share of frames of the right motion, and Eq. 6 the paper's error: the share of pairs of frames that
    one puts together and the other keeps apart. First each method is told how many motions there are, then nothing.
    Seconds and megabytes are of the cut alone. All methods see the same descriptors (`--descriptors`).
    """
    chosen, parameters = _choose_methods(methods), Parameters.parse(options.given_parameters(given))
    found = find_labelled_takes(takes)

    from caesura.service.commands.comparison.measurement import MeasuredMethod, measure_take
    from caesura.service.commands.comparison.table import comparison_table
    from caesura.worker.process.thread_count import available_threads

    measured: list[MeasuredMethod] = []
    code = 0
    for take in found:
        try:
            for one in measure_take(take, chosen, parameters, threads or available_threads(), tier):
                measured.append(one)
                click.echo(f"{one.take}: {one.method} {one.refused or f'{one.seconds:.2f} s'}", err=True)
        except CaesuraError as refused:  # a bad file does not stop the others
            code = code or exit_code(refused.problem())
            print_problem(refused.problem(), as_json=as_json, file=str(take.path))
    if as_json:
        click.echo(json.dumps([one.document() for one in measured]))
    elif measured:
        click.echo(comparison_table(measured, each=each))
    if code:
        click.get_current_context().exit(code)


def _choose_methods(names: str) -> list[str]:
    chosen = list(METHODS) if names == ALL else [name.strip() for name in names.split(",")]
    unknown = next((name for name in chosen if name not in METHODS), None)
    if unknown is not None:
        detail = f"There is no method {unknown!r}. Known: {', '.join(METHODS)}; or {ALL}."
        raise ParameterError("invalid-parameter", detail, parameter="methods")
    return chosen
