"""`caesura submit`: have a running service find the motions of a file."""

from pathlib import Path
from typing import Any

import click

from caesura.core.parameters import Parameters
from caesura.service.commands import options
from caesura.service.commands.problems import Command
from caesura.service.commands.progress_bar import ProgressBar
from caesura.service.commands.table import print_table

DEFAULT_URL = "http://127.0.0.1:8000"


@click.command(cls=Command)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--url", default=DEFAULT_URL, show_default=True, envvar="CAESURA_URL", help="The service.")
@click.option("--key", default="", envvar="CAESURA_KEY", help="Where the service wants one; CAESURA_KEY says it too.")
@options.parameter_option_decorators
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document.")
def submit(file: Path, url: str, key: str, as_json: bool, **given: Any) -> None:
    """Send FILE to a running service, wait, and print what `caesura segment` would print."""
    from caesura.service.commands.client import Client

    chosen = options.given_parameters(given)
    Parameters.parse(chosen)  # refused here, before a long upload
    with Client(url, key) as client, ProgressBar() as progress, file.open("rb") as bytes_of:
        found = client.segment(bytes_of, file.name, chosen, progress)
    click.echo(found.model_dump_json() if as_json else print_table(file.name, found))
