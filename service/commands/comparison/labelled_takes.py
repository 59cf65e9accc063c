"""Takes that have labels beside them: FILE.glb with FILE.truth.json, FILE.json, FILE.csv or FILE.eaf."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from caesura.core.errors import InvalidModel
from caesura.formats.input_formats import COMPANION_SUFFIXES

LABEL_ENDINGS = (".truth.json", ".json", ".csv", ".eaf")


@dataclass(frozen=True)
class LabelledTake:
    """A file, the files of its folder that may belong to it, and its labels."""

    path: Path
    companions: tuple[Path, ...]
    labels: Path


def find_labelled_takes(given: Iterable[Path]) -> list[LabelledTake]:
    """Every file that is given or lies in a folder that is given, and has labels, by name.

    Raises `InvalidModel` (`no-labels`) where a file that is given has none, or none at all has.
    """
    found: list[LabelledTake] = []
    for path in given:
        if path.is_dir():
            found += _of_folder(path)
        elif (labels := _labels_of(path)) is not None:
            found.append(LabelledTake(path, _companions(path), labels))
        else:
            raise _no_labels(str(path))
    if not found:
        raise _no_labels("What was given")
    return found


def _of_folder(folder: Path) -> Iterator[LabelledTake]:
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.name.endswith((*LABEL_ENDINGS, *COMPANION_SUFFIXES)):
            labels = _labels_of(path)
            if labels is not None:
                yield LabelledTake(path, _companions(path), labels)


def _labels_of(path: Path) -> Path | None:
    beside = (path.with_suffix(ending) for ending in LABEL_ENDINGS)
    return next((labels for labels in beside if labels.is_file() and labels != path), None)


def _companions(path: Path) -> tuple[Path, ...]:
    return tuple(
        one for one in sorted(path.parent.iterdir()) if one.suffix.lower() in COMPANION_SUFFIXES and one != path
    )


def _no_labels(what: str) -> InvalidModel:
    endings = ", ".join(f"FILE{ending}" for ending in LABEL_ENDINGS)
    return InvalidModel("no-labels", f"{what} has no labels beside it: of FILE.glb they are {endings}.")
