"""`caesura score`: how well a segmentation agrees with the truth."""

import json
from pathlib import Path

import click

from caesura.service.commands.labelling import Labelling, compute_agreement
from caesura.service.commands.problems import Command


@click.command(cls=Command)
@click.argument("result", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.argument("truth", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON.")
def score(result: Path, truth: Path, as_json: bool) -> None:
    """Compare RESULT, a segmentation document, with TRUTH.

    TRUTH is {"fps", "frames", "segments": [{"label", "start", "end"}]}, frames half-open; either may be either form.
    """
    figures = compute_agreement(Labelling.read(result), Labelling.read(truth))
    if as_json:
        click.echo(json.dumps(figures))
        return
    for name, value in figures.items():
        click.echo(f"{name.replace('_', ' '):<28} {value:.4f}")
