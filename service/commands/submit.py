"""`caesura submit`: have a running service find the motions of a file."""

from pathlib import Path
from typing import Any

import click

from caesura.service.commands import options
from caesura.service.commands.exit_codes import INTERRUPTED, Command
from caesura.service.commands.file_arguments import STANDARD, read_standard_input
from caesura.service.commands.terminal.progress_bar import ProgressBar
from caesura.service.commands.terminal.segment_table import print_table

DEFAULT_URL = "http://127.0.0.1:8000"


@click.command(cls=Command, short_help="Find the motions in a file, by a running service.")
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path, allow_dash=True))
@click.option("--url", default=DEFAULT_URL, show_default=True, envvar="CAESURA_URL", help="The service.")
@click.option("--key", default="", envvar="CAESURA_KEY", help="Where the service wants one; CAESURA_KEY says it too.")
@options.parameter_option_decorators
@click.option("--json", "as_json", is_flag=True, help="Print the segmentation document.")
@click.pass_context
def submit(context: click.Context, /, file: Path, url: str, key: str, as_json: bool, **given: Any) -> None:
    """Send FILE to a running service, wait, and print what `caesura segment` would print; - is standard input."""
    from caesura.client.client import Client

    source = read_standard_input() if file == STANDARD else file
    with Client(url, key) as client, ProgressBar() as progress:
        asked = client.submit(source, progress=progress, **options.given_parameters(given))
        try:
            client.wait(asked["id"], progress=progress)
        except KeyboardInterrupt:
            click.echo(f"caesura: interrupted; the service goes on with {client.url}/view/{asked['id']}", err=True)
            context.exit(INTERRUPTED)
        found = client.result(asked["id"])
    click.echo(found.model_dump_json() if as_json else print_table(file.name, found))
