"""What `caesura segment` writes beside what it prints: one file of a form, or all forms of every file in a folder."""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from caesura.core.document import SegmentationDocument
from caesura.core.errors import CaesuraError
from caesura.formats.clips.clip_options import ClipOptions
from caesura.service.commands.buffers import scratch_buffer
from caesura.service.results.elan import segments_eaf
from caesura.service.results.text_formats import frames_csv, plot_svg, segments_csv, segments_vtt

Parts = Mapping[str, memoryview]
Write = Callable[[Parts, SegmentationDocument, ClipOptions], tuple[str, Iterator[bytes]]]
"""Gives the suffix of the file and its bytes, piece by piece."""

UNNAMED = "\0"
"""What an option without a name has for a value; no file can be called so."""


def _text(suffix: str, written: Callable[[SegmentationDocument], str]) -> Write:
    return lambda _parts, found, _options: (suffix, iter([written(found).encode()]))


def _clips(parts: Parts, found: SegmentationDocument, options: ClipOptions) -> tuple[str, Iterator[bytes]]:
    from caesura.formats.clips.write import GLB, write_clips

    written = write_clips(parts, found, options, scratch_buffer)
    return ".clips.glb" if written.media_type == GLB else ".clips.zip", written.pieces


def _key_poses(parts: Parts, found: SegmentationDocument, _: ClipOptions) -> tuple[str, Iterator[bytes]]:
    from caesura.formats.clips.write import write_key_poses

    return ".keyframes.glb", write_key_poses(parts, found, scratch_buffer).pieces


def _plot_png(_parts: Parts, found: SegmentationDocument, _options: ClipOptions) -> tuple[str, Iterator[bytes]]:
    from caesura.core.plot.layout import lay_out_picture
    from caesura.core.plot.png import render_png

    font = os.environ.get("CAESURA_FONT")
    return ".png", iter([render_png(lay_out_picture(found), Path(font).read_bytes() if font else None)])


OUTPUT_FORMATS: dict[str, tuple[Write, str]] = {
    "clips": (_clips, "Write the file again with its motions as clips: a GLB, or a zip."),
    "keyframes": (_key_poses, "Write the file again with its key poses alone, as a GLB."),
    "csv": (_text(".csv", segments_csv), "Write the segments as CSV."),
    "frames_csv": (_text(".frames.csv", frames_csv), "Write motion and energy of every frame as CSV."),
    "vtt": (_text(".vtt", segments_vtt), "Write the segments as WebVTT, for video players."),
    "eaf": (_text(".eaf", segments_eaf), "Write motions and key-frames as EAF, for ELAN."),
    "plot": (_text(".svg", plot_svg), "Draw the energy curve over the segments as SVG, for papers."),
    "plot_png": (_plot_png, "Draw the same as PNG."),
}
DOCUMENT = _text(".json", lambda found: found.model_dump_json())


def output_option_decorators(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for each form; the command receives it as `write_NAME`. With `--out` it needs no name."""
    for name, (_, text) in reversed(OUTPUT_FORMATS.items()):
        option = click.option(
            f"--{name.replace('_', '-')}",
            f"write_{name}",
            metavar="[FILE]",
            is_flag=False,
            flag_value=UNNAMED,
            help=text,
        )
        function = option(function)
    return function


@dataclass(frozen=True)
class Outputs:
    """The forms that were asked for, by name, with the file each goes to; with `--out`, their names alone."""

    forms: Mapping[str, Path | None]
    options: ClipOptions

    @classmethod
    def of(
        cls,
        arguments: Mapping[str, Any],
        options: ClipOptions,
        animations: Sequence[Path],
        companions: Sequence[Path],
        folder: Path | None,
    ) -> "Outputs":
        """Out of a command's keyword arguments; raises `UsageError` where files would be lost or are not named."""
        sources = [*animations, *companions]
        forms: dict[str, Path | None] = {}
        for form in OUTPUT_FORMATS:
            given = arguments[f"write_{form}"]
            if given is None:
                continue
            flag = f"--{form.replace('_', '-')}"
            if folder is None and given == UNNAMED:
                raise click.UsageError(f"{flag} needs the name of a file; with --out DIR it needs none.")
            if folder is None and len(animations) > 1:
                raise click.UsageError(f"{flag} names one file: give one animation at a time, or a folder with --out.")
            if folder is not None and given != UNNAMED:
                raise click.UsageError(
                    f"With --out, {flag} takes no name. Put it after the files, or before an option."
                )
            forms[form] = None if given == UNNAMED else _place(flag, Path(given), sources, forms.values())
        if options.model_fields_set and "clips" not in forms:
            flag = f"--{min(options.model_fields_set).replace('_', '-')}"
            raise click.UsageError(f"{flag} says how clips are made: it needs --clips beside it.")
        return cls(forms, options)

    def write(self, parts: Parts, found: SegmentationDocument, target: Path | None) -> None:
        """Every form that was asked for; into a folder also the document, first.

        A form that this result has not, such as key poses of a short take, is refused after the others are written.
        """
        refused: list[CaesuraError] = []
        if target is not None:
            target.parent.mkdir(parents=True, exist_ok=True)
            self._one(DOCUMENT, parts, found, target, None)
        for form, path in self.forms.items():
            try:
                self._one(OUTPUT_FORMATS[form][0], parts, found, target, path)
            except CaesuraError as missing:
                refused.append(missing)
        if refused:
            raise refused[0]

    def _one(
        self, write: Write, parts: Parts, found: SegmentationDocument, target: Path | None, path: Path | None
    ) -> None:
        suffix, pieces = write(parts, found, self.options)
        _save(path or (target or Path()).with_name(f"{(target or Path()).name}{suffix}"), pieces)


def _place(flag: str, path: Path, sources: Sequence[Path], taken: Iterable[Path | None]) -> Path:
    """The path, where it can be written and no other form goes there; else `UsageError`, before the long work."""
    if not path.parent.is_dir():
        raise click.UsageError(f"There is no folder '{path.parent}' for {flag}: make it first.")
    if path.is_dir():
        raise click.UsageError(f"'{path}' is a folder: {flag} needs the name of a file.")
    if any(other is not None and other.resolve() == path.resolve() for other in taken):
        raise click.UsageError(f"'{path}' is named twice: {flag} needs a file of its own.")
    is_read = path.is_file() and any(map(path.samefile, sources))
    if is_read and (flag != "--clips" or path.suffix.lower() == ".bin"):
        raise click.UsageError(f"'{path}' is one of the files to read, and {flag} would write over it: name another.")
    if path.is_file() and not is_read and _is_an_animation(path):
        raise click.UsageError(
            f"'{path}' is an animation, and {flag} would write over it. Put the files before the options, or name"
            " another file."
        )
    return path


def _is_an_animation(path: Path) -> bool:
    """Whether the file holds an animation that is not clips of ours, which may be made again.

    So that `--clips a.glb b.glb`, where both were meant to be cut, loses nothing.
    """
    with path.open("rb") as file:
        start = file.read(20)
        if start[:4] != b"glTF":
            return path.suffix.lower() in {".gltf", ".npz", ".bvh"}
        return b'"caesura"' not in file.read(int.from_bytes(start[12:16], "little"))


def _save(path: Path, pieces: Iterable[bytes]) -> None:
    """Write it aside, then to its name: it is whole or not there, and may replace the file that it is made of.

    A link is followed; a device or a pipe, such as /dev/stdout, is written to and stays what it is.
    """
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
