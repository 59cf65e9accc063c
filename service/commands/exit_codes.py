"""The exit code of a command, and its error as a sentence or as JSON."""

import errno
import json
import os
import sys
from collections.abc import Mapping
from typing import Any

import click

from caesura.client.errors import Unreachable
from caesura.core.errors import ERROR_KINDS, CaesuraError, InputError
from caesura.worker.control_characters import escape_control_characters

FAULT = 1
USAGE = 2
BAD_FILE = 3
UNREACHABLE = 4
NOT_WRITTEN = 5
INTERRUPTED = 130
BROKEN_PIPE = 141
TERMINATED = 143

EXIT_CODES = {
    0: "done",
    FAULT: "a fault of Caesura's",
    USAGE: "wrong usage",
    BAD_FILE: "bad file",
    UNREACHABLE: "server unreachable or unable",
    NOT_WRITTEN: "output not written, such as on a full disk",
    INTERRUPTED: "Ctrl-C",
    BROKEN_PIPE: "nobody reads the output any more",
    TERMINATED: "told to end",
}
NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


class NotWritten(CaesuraError):
    """A result could not be written where it should go."""

    kind = "output"

    @classmethod
    def because(cls, fault: OSError, where: str) -> "NotWritten":
        """The refusal for an error of the system; `disk-full` where there is no room."""
        code = "disk-full" if fault.errno in NO_ROOM else "not-written"
        return cls(code, f"{where} could not be written: {fault.strerror or fault}.")


def exit_code(problem: Mapping[str, Any]) -> int:
    """2 for a parameter, 3 for a file, 5 for an output; what is none of them, only a server can have said."""
    kind = problem.get("kind")
    if kind in {"parameter", "usage"}:
        return USAGE
    if kind in {"bug", "output"}:
        return FAULT if kind == "bug" else NOT_WRITTEN
    return BAD_FILE if issubclass(ERROR_KINDS.get(str(kind), Exception), InputError) else UNREACHABLE


def system_problem(fault: OSError) -> dict[str, Any]:
    """An error of the system as a problem: of an output where there is no room, else of a file."""
    if fault.errno in NO_ROOM:
        return NotWritten("disk-full", f"There is no room: {fault.strerror}.").problem()
    detail = f"It could not be read, or its results not written: {fault}."
    return {"kind": "input", "code": "file-system", "detail": detail}


def print_problem(problem: Mapping[str, Any], *, as_json: bool, file: str | None = None) -> int:
    """Say what was wrong, and with which file, on stderr: one sentence, or the problem document; its exit code."""
    if as_json:
        click.echo(json.dumps({**problem, "file": file} if file else problem), err=True)
    else:
        line = f"caesura: {file + ': ' if file else ''}{problem['detail']} [{problem['code']}]"
        click.echo(escape_control_characters(line), err=True)
    return exit_code(problem)


def leave_broken_pipe() -> int:
    """Write nothing more, not even what is still held back for a reader that has gone; the exit code."""
    with open(os.devnull, "wb") as nowhere:  # noqa: PTH123  its number is what is wanted
        os.dup2(nowhere.fileno(), sys.stdout.fileno())
    return BROKEN_PIPE


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
        """Run; a refusal that the command does not handle itself ends it here, and so does Ctrl-C."""
        try:
            try:
                return self._invoke(ctx)
            finally:
                sys.stdout.flush()  # here a full disk can still be said
        except BrokenPipeError:
            ctx.exit(leave_broken_pipe())
        except KeyboardInterrupt:
            click.echo("caesura: interrupted", err=True)
            ctx.exit(INTERRUPTED)
        except OSError as fault:
            if fault.errno in NO_ROOM:
                leave_broken_pipe()
            ctx.exit(print_problem(system_problem(fault), as_json=ctx.params.get("as_json", False)))

    def _invoke(self, ctx: click.Context) -> Any:
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
