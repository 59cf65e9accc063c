"""`caesura formats`: the kinds of files that are read."""

import click

from caesura.formats.input_formats import INPUT_FORMATS, InputFormat
from caesura.service.commands.exit_codes import Command


@click.command(cls=Command, short_help="List the kinds of files that are read.")
def formats() -> None:
    """List the kinds of files that are read. They are told by their first bytes, not by their names."""
    width = max(len(_files(known)) for known in INPUT_FORMATS.values())
    for known in INPUT_FORMATS.values():
        click.echo(f"{_files(known):<{width}}  {known.title}: {known.description}")


def _files(known: InputFormat) -> str:
    return ", ".join(known.suffixes) + (f" + {known.companion.suffix}" if known.companion else "")
