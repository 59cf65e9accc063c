"""The exit code of a command, and its error as a sentence or as JSON."""

import json
import sys
from collections.abc import Mapping
from typing import Any

import click

from caesura.core.control_characters import escape_control_characters
from caesura.core.errors import ERROR_KINDS, CaesuraError, InputError

USAGE = 2
BAD_FILE = 3
UNREACHABLE = 4


class Unreachable(CaesuraError):
    """There is no server to talk to, or it cannot do its work."""

    kind = "unreachable"


def exit_code(problem: Mapping[str, Any]) -> int:
    """2 for a parameter, 3 for a file; what is neither, only a server can have said."""
    kind = problem.get("kind")
    if kind in {"parameter", "usage"}:
        return USAGE
    return BAD_FILE if issubclass(ERROR_KINDS.get(str(kind), Exception), InputError) else UNREACHABLE


def print_problem(problem: Mapping[str, Any], *, as_json: bool, file: str | None = None) -> int:
    """Say what was wrong, and with which file, on stderr: one sentence, or the problem document; its exit code."""
    if as_json:
        click.echo(json.dumps({**problem, "file": file} if file else problem), err=True)
    else:
        line = f"caesura: {file + ': ' if file else ''}{problem['detail']} [{problem['code']}]"
        click.echo(escape_control_characters(line), err=True)
    return exit_code(problem)


class Command(click.Command):
    """A command that ends as its problem says; with `--json` wrong usage is a problem document too."""

    def make_context(self, info_name: str | None, args: list[str], *rest: Any, **extra: Any) -> click.Context:
        """Read the options; with `--json` among them, refuse in JSON."""
        as_json = "--json" in args
        try:
            return super().make_context(info_name, args, *rest, **extra)
        except click.UsageError as refused:
            if not as_json:
                raise click.UsageError(escape_control_characters(refused.format_message()), refused.ctx) from None
            problem = {"kind": "usage", "code": "usage", "detail": refused.format_message()}
            raise click.exceptions.Exit(print_problem(problem, as_json=True)) from None

    def invoke(self, ctx: click.Context) -> Any:
        """Run; a refusal that the command does not handle itself ends it here."""
        as_json = ctx.params.get("as_json", False)
        try:
            return super().invoke(ctx)
        except click.UsageError as refused:
            if not as_json:
                raise click.UsageError(escape_control_characters(refused.format_message()), refused.ctx) from None
            ctx.exit(
                print_problem({"kind": "usage", "code": "usage", "detail": refused.format_message()}, as_json=True)
            )
        except CaesuraError as refused:
            ctx.exit(print_problem(refused.problem(), as_json=as_json))
        except ModuleNotFoundError as missing:
            name = (missing.name or "").partition(".")[0]
            if name in {"core", "samples", "service", "worker"} | sys.stdlib_module_names:
                raise
            detail = f"{name} is not installed, which this command needs. Install caesura[service]."
            ctx.exit(print_problem(Unreachable("not-installed", detail).problem(), as_json=as_json))
