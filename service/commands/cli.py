"""`caesura`: the command. Each subcommand lives in a file here, those of takes cut together in `joint`."""

import io
import sys

import click

from caesura.service.commands.compare import compare
from caesura.service.commands.demo import demo
from caesura.service.commands.exit_codes import EXIT_CODES
from caesura.service.commands.formats import formats
from caesura.service.commands.joint.find import find
from caesura.service.commands.joint.rename import rename
from caesura.service.commands.keys import keys
from caesura.service.commands.options import with_dashes
from caesura.service.commands.score import score
from caesura.service.commands.segment import segment
from caesura.service.commands.serve import serve
from caesura.service.commands.submit import submit
from caesura.service.commands.worker import worker

EXIT_CODES_TABLE = "\n".join(f"{code:>4}  {meaning}" for code, meaning in EXIT_CODES.items())
HELP = f"""Find the motions in a 3D animation: key-frames, labels, cuts and named clips.

\b
Exit codes:
{EXIT_CODES_TABLE}
"""


@click.group(help=HELP, context_settings={"help_option_names": ["-h", "--help"], "token_normalize_func": with_dashes})
@click.version_option(package_name="caesura")
def main() -> None:
    """Write what a console of few letters cannot as escapes, and run the command."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a console of few letters must not end a night's batch
            stream.reconfigure(errors="backslashreplace")


for command in (serve, worker, keys, segment, find, rename, submit, score, compare, formats, demo):
    main.add_command(command)


if __name__ == "__main__":
    main()
