"""`caesura rename`: the motions of takes that were cut together, called as a person calls them."""

import json
from pathlib import Path

import click

from caesura.service.commands.exit_codes import Command
from caesura.service.commands.joint.find import FOLDER
from caesura.service.commands.joint.motion_names import parse_names
from caesura.worker.control_characters import escape_control_characters


@click.command(cls=Command, short_help="Name the motions of takes that were cut together.")
@click.argument("folder", type=FOLDER)
@click.argument("names", metavar="OLD=NEW...", nargs=-1, required=True)
@click.option("--json", "as_json", is_flag=True, help="Print the takes and motions as JSON.")
def rename(folder: Path, names: tuple[str, ...], as_json: bool) -> None:
    """Call motions of FOLDER otherwise, which `segment --together --out` wrote: A=walk B=run.

    Tables, documents and clips are written again with the new names, and nothing is cut. Clips are made of the files
    that were cut, which must still be where they were. Without a new name, as in walk=, a motion has its letters again.
    """
    from caesura.service.commands.joint.output import joint_document, joint_table
    from caesura.service.commands.joint.renaming import rename_in_folder

    found = rename_in_folder(folder, parse_names(names))
    if as_json:
        click.echo(json.dumps(joint_document(found.collection)))
    else:
        click.echo("\n".join(map(escape_control_characters, joint_table(found.collection).split("\n"))))
