"""`caesura score`: how well a segmentation agrees with the truth."""

import json
from pathlib import Path

import click

from caesura.service.commands.exit_codes import Command
from caesura.service.commands.file_arguments import STANDARD
from caesura.service.commands.frame_labels import compute_agreement
from caesura.service.commands.label_files.read import read_both

RATE = click.FloatRange(0, 1000, min_open=True)


@click.command(cls=Command, short_help="Compare a segmentation with the truth.")
@click.argument("result", type=click.Path(exists=True, dir_okay=False, path_type=Path, allow_dash=True))
@click.argument("truth", type=click.Path(exists=True, dir_okay=False, path_type=Path, allow_dash=True))
@click.option("--tier", help="The tier of an EAF.  [default: the first with annotations]")
@click.option(
    "--fps", type=click.FloatRange(0, 1000, min_open=True), help="Frames per second, where neither file says them."
)
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON.")
def score(result: Path, truth: Path, tier: str | None, fps: float | None, as_json: bool) -> None:
    """Compare RESULT, a segmentation document, with TRUTH; either may be a file of any kind that is named here.

    \b
    JSON  a segmentation document, or {"fps", "frames", "segments": [{"label",
          "start", "end"}]}, frames half-open
    CSV   columns start and end in frames, or start_seconds and end_seconds,
          and label, motion or name
    EAF   annotations of ELAN, of one tier

    Frames that nobody has labelled are a label of their own. One of the two may be -, standard input.
    """
    if STANDARD == result == truth:
        raise click.UsageError("Only one of the two can be standard input.")
    figures = compute_agreement(*read_both(result, truth, tier=tier, fps=fps))
    if as_json:
        click.echo(json.dumps(figures))
        return
    for name, value in figures.items():
        click.echo(f"{name.replace('_', ' '):<28} {value:.4f}")
