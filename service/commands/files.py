"""The files that a command is given, and where what is made of each goes."""

from collections import Counter
from collections.abc import Sequence
from os.path import commonpath
from pathlib import Path

import click


class ExistingFiles(click.ParamType[tuple[Path, ...]]):
    """A file, or a pattern of files: shells such as Windows' leave `*.glb` to the program."""

    name = "file"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> tuple[Path, ...]:
        """The files that are meant, in order of their names; wrong usage where there is none."""
        path = Path(value)
        if path.is_file():
            return (path,)
        if path.is_dir():
            self.fail(f"{value!r} is a folder; say which of its files, such as '{path / '*.glb'}'.", param, ctx)
        found = expand_pattern(path)
        if not found:
            self.fail(f"There is no file {value!r}.", param, ctx)
        return found


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
    above = Path(commonpath([path.absolute().parent for path in files]))
    places = [path.absolute().relative_to(above) for path in files]
    stems = Counter(str(place.with_suffix("")).casefold() for place in places)
    return [
        folder / (place if stems[str(place.with_suffix("")).casefold()] > 1 else place.with_suffix(""))
        for place in places
    ]
