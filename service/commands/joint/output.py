"""What `caesura segment --together` writes: one table and one document over all takes, and what `find` needs."""

import csv
import io
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.clip_names import engine_safe_name
from caesura.service.commands.exit_codes import NotWritten
from caesura.service.commands.output_files import Outputs

if TYPE_CHECKING:
    from caesura.core.together.motion_collection import MotionCollection
    from caesura.joint_segmentation import JointSegmentation

COLLECTION, DOCUMENT = "motions.npz", "motions.json"
COLUMNS = ("take", "name", "motion", "start", "end", "start_seconds", "end_seconds", "sure", "best", "duplicate_of")


def write_joint(
    found: "JointSegmentation", folder: Path, outputs: Outputs, sources: Mapping[str, Sequence[Path]]
) -> None:
    """`motions.csv`, `motions.json`, and `motions.npz`, which `caesura find` searches, last.

    The document says too which files each take was read from, by its place from the folder, and what was made of all.
    """
    document = joint_document(found.collection)
    for take in document["takes"]:
        take["files"] = [os.path.relpath(path, folder) for path in sources[take["name"]]]
    document["outputs"] = {"forms": [*outputs.forms], "options": outputs.options.model_dump(exclude_unset=True)}
    files = {
        "motions.csv": joint_csv(found.collection).encode(),
        DOCUMENT: (json.dumps(document, indent=1) + "\n").encode(),
        COLLECTION: found.to_bytes(),
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, data in files.items():
            aside = folder / f".{name}.part"
            aside.write_bytes(data)
            aside.replace(folder / name)
    except OSError as fault:
        raise NotWritten.because(fault, str(folder)) from fault


def take_outputs(outputs: Outputs, source: Path) -> Outputs:
    """The outputs of one take: where nobody says otherwise, clips are called after motion, file and number."""
    if "clips" not in outputs.forms or "names" in outputs.options.model_fields_set:
        return outputs
    named = engine_safe_name(source.stem).replace("{", "").replace("}", "")
    options = outputs.options.model_copy(update={"names": f"{{motion}}_{named}_{{number}}"})
    return replace(outputs, options=options)


def joint_document(collection: "MotionCollection") -> dict[str, Any]:
    """The collection as JSON, with the best segment of each motion and duplicates marked."""
    document = collection.document()
    marks = iter(_marks(collection))
    by_place = {(take, start): mark for take, start, *mark in marks}
    for take in document["takes"]:
        for segment in take["segments"]:
            best, duplicate = by_place[take["name"], segment["start"]]
            segment |= {"best": best, "duplicate_of": duplicate or None}
    return document


def joint_csv(collection: "MotionCollection") -> str:
    """A row for each segment of every take; `best` is 1 for the one most like all others of its motion."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    names = collection.shown_names
    rates = {take.name: take.frame_rate for take in collection.takes}
    for one, (_, _, best, duplicate) in zip(collection.segments, _marks(collection), strict=True):
        seconds = (f"{frame / rates[one.take]:.6f}" for frame in (one.start, one.end))
        row = (one.take, names[one.motion], one.motion, one.start, one.end, *seconds, f"{one.sure:.4f}", int(best))
        writer.writerow((*row, duplicate))
    return out.getvalue()


def in_common_motions(document: SegmentationDocument, take: str, found: "JointSegmentation") -> SegmentationDocument:
    """The document of one take with its segments named by the motions of all."""
    names = found.collection.shown_names
    common = {segment.start: segment.motion for segment in found.collection.of_take(take)}
    segments = tuple(
        segment.model_copy(update={"motion": common[segment.start], "name": names[common[segment.start]]})
        for segment in document.segments
    )
    return document.model_copy(update={"segments": segments})


def joint_table(collection: "MotionCollection") -> str:
    """A line for each motion, for a person."""
    motions = collection.motions
    width = max(len("motion"), *(len(motion.shown_name) for motion in motions))
    lines = [f"{'motion':<{width}}  {'seconds':>8}  segments  takes  most like all others"]
    for motion in motions:
        best = collection.segments[motion.exemplar]
        place = f"{best.take} {best.start}:{best.end}"
        counts = f"{motion.seconds:8.2f}  {motion.segments:8}  {motion.takes:5}"
        lines.append(f"{motion.shown_name:<{width}}  {counts}  {place}")
    return "\n".join([*lines, "", f"{len(motions)} motions in {len(collection.takes)} takes"])


def _marks(collection: "MotionCollection") -> Iterator[tuple[str, int, bool, str]]:
    """Of every segment: its take and first frame, whether it is the best of its motion, and what it is again."""
    from caesura.core.together.duplicates import best_segments, find_duplicates

    best, duplicates = best_segments(collection), find_duplicates(collection)
    for i, segment in enumerate(collection.segments):
        first = collection.segments[duplicates[i]] if i in duplicates else None
        yield segment.take, segment.start, i in best, f"{first.take}:{first.start}" if first else ""
