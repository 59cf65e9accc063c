"""What `caesura segment` writes beside what it prints: one file of a form, or all forms of every file in a folder."""

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from caesura.core.errors import CaesuraError
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.exports.export_table import EXPORTS, Export, ExportSource, exports_of
from caesura.formats.input_formats import INPUT_FORMATS
from caesura.mapped_files import scratch_buffer
from caesura.service.commands.exit_codes import NotWritten
from caesura.service.commands.file_arguments import STANDARD

Parts = Mapping[str, memoryview]
UNNAMED = "\0"
"""What an option without a name has for a value; no file can be called so."""

OUTPUT_FORMATS = {export.option: export for export in EXPORTS if export.option}
ANIMATION_SUFFIXES = {suffix for known in INPUT_FORMATS.values() for suffix in known.suffixes}
DOCUMENT = exports_of("result")["json"]


def output_option_decorators(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for each form; the command receives it as `write_NAME`. With `--out` it needs no name."""
    for name, export in reversed(OUTPUT_FORMATS.items()):
        option = click.option(
            f"--{name.replace('_', '-')}",
            f"write_{name}",
            metavar="[FILE]",
            is_flag=False,
            flag_value=UNNAMED,
            help=export.option_help,
            shell_complete=lambda *given: [CompletionItem(given[-1], type="file")],
        )
        function = option(function)
    return function


@dataclass(frozen=True)
class Outputs:
    """The forms that were asked for, by name, with the file each goes to; with `--out`, their names alone."""

    forms: Mapping[str, Path | None]
    options: ClipOptions
    sources: tuple[Path, ...] = ()
    force: bool = False

    @classmethod
    def of(
        cls,
        arguments: Mapping[str, Any],
        options: ClipOptions,
        animations: Sequence[Path],
        companions: Sequence[Path],
        targets: Sequence[Path | None],
        *,
        force: bool,
    ) -> "Outputs":
        """Out of a command's keyword arguments; raises `UsageError` where files would be lost or are not named.

        `targets` are the names in a folder without their endings, one for each animation, or None.
        """
        sources = [path for path in [*animations, *companions] if path != STANDARD]
        into_folder = targets[0] is not None
        forms: dict[str, Path | None] = {}
        for form in OUTPUT_FORMATS:
            given = arguments[f"write_{form}"]
            if given is None:
                continue
            flag = f"--{form.replace('_', '-')}"
            if not into_folder and given == UNNAMED:
                raise click.UsageError(f"{flag} needs the name of a file; with --out DIR it needs none.")
            if not into_folder and len(animations) > 1:
                raise click.UsageError(f"{flag} names one file: give one animation at a time, or a folder with --out.")
            if into_folder and given != UNNAMED:
                raise click.UsageError(
                    f"With --out, {flag} takes no name. Put it after the files, or before an option."
                )
            path = None if given == UNNAMED else Path(given)
            forms[form] = path and _check_output_path(flag, path, sources, forms.values(), force=force)
        if options.model_fields_set and "clips" not in forms:
            flag = f"--{min(options.model_fields_set).replace('_', '-')}"
            raise click.UsageError(f"{flag} says how clips are made: it needs --clips beside it.")
        outputs = cls(forms, options, tuple(sources), force)
        for target in filter(None, targets):
            outputs.check_folder(target)
        return outputs

    @property
    def to_standard_output(self) -> bool:
        """Whether one of the forms goes there, so that nothing else may."""
        return STANDARD in self.forms.values()

    def check_folder(self, target: Path) -> None:
        """Raises `UsageError` where a form of this name would be written over a file that is read."""
        for export in [DOCUMENT, *(OUTPUT_FORMATS[form] for form in self.forms)]:
            for media_type in (export.media_type, "application/zip"):
                self._keep_sources(target.with_name(f"{target.name}{export.file_ending(media_type)}"))

    def _keep_sources(self, path: Path) -> None:
        if not self.force and path.is_file() and any(map(path.samefile, self.sources)):
            raise click.UsageError(
                f"'{path}' is one of the files to read, and a result is called so: choose another folder, or --force."
            )

    def write(self, parts: Parts, found: SegmentationDocument, target: Path | None) -> None:
        """Every form that was asked for; into a folder also the document, first.

        A form that this result has not, such as key poses of a short take, is refused after the others are written.
        """
        refused: list[CaesuraError] = []
        if target is not None:
            try:
                target.parent.mkdir(parents=True, exist_ok=True)
            except OSError as fault:
                raise NotWritten.because(fault, str(target.parent)) from fault
            self._one(DOCUMENT, parts, found, target, None)
        for form, path in self.forms.items():
            try:
                self._one(OUTPUT_FORMATS[form], parts, found, target, path)
            except CaesuraError as missing:
                refused.append(missing)
        if refused:
            raise refused[0]

    def _one(
        self, export: Export, parts: Parts, found: SegmentationDocument, target: Path | None, path: Path | None
    ) -> None:
        font = os.environ.get("CAESURA_FONT")
        written = export.write(
            ExportSource(
                found,
                font=lambda: Path(font).read_bytes() if font else None,
                parts=parts,
                options=self._options(path),
                scratch=scratch_buffer,
            )
        )
        ending = export.file_ending(written.media_type)
        _save(path or (target or Path()).with_name(f"{(target or Path()).name}{ending}"), written.pieces)

    def _options(self, path: Path | None) -> ClipOptions:
        """Those that were given; of a file that is called so, clips are a GLB."""
        called_so = path is not None and path.suffix.lower() == ".glb" and "form" not in self.options.model_fields_set
        return self.options.model_copy(update={"form": "glb"}) if called_so else self.options


def _check_output_path(
    flag: str, path: Path, sources: Sequence[Path], taken: Iterable[Path | None], *, force: bool
) -> Path:
    """The path, where it can be written and no other form goes there; else `UsageError`, before the long work."""
    if path == STANDARD:
        if STANDARD in taken:
            raise click.UsageError(f"Only one output can go to standard output: {flag} needs the name of a file.")
        if sys.stdout.isatty() and OUTPUT_FORMATS[flag[2:].replace("-", "_")].queued:
            raise click.UsageError(f"{flag} - is no text, and standard output is a terminal: send it into a file.")
        return path
    if not path.parent.is_dir():
        raise click.UsageError(f"There is no folder '{path.parent}' for {flag}: make it first.")
    if path.is_dir():
        raise click.UsageError(f"'{path}' is a folder: {flag} needs the name of a file.")
    if any(other is not None and other.resolve() == path.resolve() for other in taken):
        raise click.UsageError(f"'{path}' is named twice: {flag} needs a file of its own.")
    if force or not path.is_file():
        return path
    if any(map(path.samefile, sources)):
        raise click.UsageError(
            f"'{path}' is one of the files to read, and {flag} would write over it: name another, or give --force."
        )
    if _is_an_animation(path):
        raise click.UsageError(
            f"'{path}' is an animation, and {flag} would write over it. Put the files before the options, name"
            " another file, or give --force."
        )
    return path


def _is_an_animation(path: Path) -> bool:
    """Whether the file holds an animation that is not clips of ours, which may be made again.

    So that `--clips a.glb b.glb`, where both were meant to be cut, loses nothing.
    """
    with path.open("rb") as file:
        start = file.read(20)
        if start[:4] != b"glTF":
            return path.suffix.lower() in ANIMATION_SUFFIXES - {".zip", ".glb"}
        return b'"caesura"' not in file.read(int.from_bytes(start[12:16], "little"))


def _save(path: Path, pieces: Iterable[bytes]) -> None:
    """Write it aside, then to its name: it is whole or not there, and may replace the file that it is made of.

    A link is followed; a device or a pipe, such as /dev/stdout, is written to and stays what it is.
    """
    if path == STANDARD:
        sys.stdout.flush()
        sys.stdout.buffer.writelines(pieces)
        sys.stdout.buffer.flush()
        return
    try:
        _save_file(path, pieces)
    except BrokenPipeError:
        raise
    except OSError as fault:
        raise NotWritten.because(fault, str(path)) from fault


def _save_file(path: Path, pieces: Iterable[bytes]) -> None:
    if path.exists() and not path.is_file():
        with path.open("wb") as file:
            file.writelines(pieces)
        return
    place = path.resolve()
    aside = place.with_name(f".{place.name}.part")
    try:
        with aside.open("wb") as file:
            file.writelines(pieces)
        aside.replace(place)
    finally:
        aside.unlink(missing_ok=True)
