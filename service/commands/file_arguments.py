"""The files that a command is given, and the output path of each."""

import sys
from collections import Counter
from collections.abc import Sequence
from os.path import commonpath
from pathlib import Path

import click
from click.shell_completion import CompletionItem

from caesura.file_sources import open_parts

STANDARD = Path("-")
"""Standard input, or standard output; a file of that name is `./-`."""


class ExistingFiles(click.ParamType[tuple[Path, ...]]):
    """A file, or a pattern of files: shells such as Windows' leave `*.glb` to the program."""

    name = "file"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> tuple[Path, ...]:
        """The files that are meant, in order of their names; wrong usage where there is none."""
        path = Path(value)
        if value == str(STANDARD):
            return (STANDARD,)
        if path.is_file():
            return (path,)
        if path.is_dir():
            self.fail(f"{value!r} is a folder; say which of its files, such as '{path / '*.glb'}'.", param, ctx)
        found = expand_pattern(path)
        if not found:
            self.fail(f"There is no file {value!r}.", param, ctx)
        return found

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:  # noqa: ARG002  click's
        """Names of files are completed by the shell."""
        return [CompletionItem(incomplete, type="file")]


def read_standard_input() -> memoryview:
    """All of it; mapped where it is a plain file, so that `< take.glb` costs no more than the file's name would."""
    return next(iter(open_parts(sys.stdin.buffer).values()))


def expand_pattern(pattern: Path) -> tuple[Path, ...]:
    """The files of a pattern with `*`, `?`, `[…]` or `**`, sorted; none where it is no pattern."""
    if not set("*?[") & set(str(pattern)):
        return ()
    below = str(pattern)[len(pattern.anchor) :]
    return tuple(sorted(path for path in Path(pattern.anchor or ".").glob(below) if path.is_file()))


def output_paths(files: Sequence[Path], folder: Path) -> list[Path]:
    """Where in `folder` the results of each file go, without a suffix: as the files lie below what they share.

    Files of one name but for the suffix keep theirs, so that no result is written over another.
    """
    if not files:
        return []
    files = [Path("stdin") if path == STANDARD else path for path in files]
    above = Path(commonpath([path.absolute().parent for path in files]))
    places = [path.absolute().relative_to(above) for path in files]
    stems = Counter(str(place.with_suffix("")).casefold() for place in places)
    return [
        folder / (place if stems[str(place.with_suffix("")).casefold()] > 1 else place.with_suffix(""))
        for place in places
    ]
