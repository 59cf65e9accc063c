"""Motions of a folder that `segment --together` wrote, called otherwise: its files are written again, not cut."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from caesura.core.errors import InvalidModel
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import open_parts
from caesura.formats.clips.clip_options import ClipOptions
from caesura.service.commands.joint.motion_names import rename_motions
from caesura.service.commands.joint.output import COLLECTION, DOCUMENT, in_common_motions, take_outputs, write_joint
from caesura.service.commands.output_files import OUTPUT_FORMATS, Outputs

if TYPE_CHECKING:
    from caesura.joint_segmentation import JointSegmentation


@dataclass(frozen=True)
class WrittenTake:
    """A take of the folder: its name, its own document, and the files that it is made of."""

    name: str
    document: SegmentationDocument
    files: tuple[Path, ...]


def rename_in_folder(folder: Path, names: Mapping[str, str]) -> "JointSegmentation":
    """Write everything in the folder again with new names by old ones; what the folder holds now.

    The collection is written last: cut short, the same call does it all again. Raises `UsageError` where the folder
    holds no takes, `InvalidModel` where a file is gone that clips are made of, and what `rename_motions` raises.
    """
    from caesura.joint_segmentation import JointSegmentation

    before = JointSegmentation.from_bytes(_read(folder, COLLECTION))
    found = JointSegmentation(rename_motions(before.collection, names), before.takes)
    try:
        described = json.loads(_read(folder, DOCUMENT))
        outputs = _outputs(described["outputs"], before, found)
        takes = [_written(folder, take) for take in described["takes"]]
    except (ValueError, KeyError, TypeError) as wrong:
        raise InvalidModel("malformed-result", f"{folder / DOCUMENT} is not as this program writes it.") from wrong
    for take in takes if any(OUTPUT_FORMATS[form].of_upload for form in outputs.forms) else []:
        for missing in (path for path in take.files if not path.is_file()):
            detail = f"Its clips are made of {missing}, which is not there. Nothing is renamed."
            raise InvalidModel("file-missing", f"{take.name}: {detail}")
    for take in takes:
        parts = open_parts([path for path in take.files if path.is_file()])
        named = in_common_motions(take.document, take.name, found)
        take_outputs(outputs, take.files[0]).write(parts, named, folder / take.name)
    write_joint(found, folder, outputs, {take.name: take.files for take in takes})
    return found


def _outputs(described: Mapping[str, Any], before: "JointSegmentation", found: "JointSegmentation") -> Outputs:
    """The forms and options of the folder; motions that options name are named anew."""
    options = ClipOptions.of(described["options"])
    new = {name: found.collection.shown_names[motion] for motion, name in before.collection.shown_names.items()}
    renamed = {
        option: ",".join(new.get(name, name) for name in sorted(given))
        for option, given in (("loop", options.loop_names()), ("discard", options.discard_names()))
        if given
    }
    return Outputs(dict.fromkeys(described["forms"]), options.model_copy(update=renamed))


def _written(folder: Path, take: Mapping[str, Any]) -> WrittenTake:
    target = folder / take["name"]
    if not target.resolve().is_relative_to(folder.resolve()):
        raise ValueError(f"{target} is not in {folder}")  # a folder of somebody else's may say anything
    document = SegmentationDocument.model_validate_json(_read(folder, f"{take['name']}.json"))
    return WrittenTake(take["name"], document, tuple(folder / file for file in take["files"]))


def _read(folder: Path, name: str) -> bytes:
    path = folder / name
    if not path.is_file():
        raise click.UsageError(f"'{path}' is not there: make it with caesura segment --together --out.")
    return path.read_bytes()
