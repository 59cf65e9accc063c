"""Labels that a person brings: a result document, a truth, a CSV or an EAF beside the file they are of."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
from jaxtyping import Int

from caesura.service.commands.frame_labels import Labelling

ENDINGS = (".truth.json", ".json", ".csv", ".eaf")
MODELS = (".glb", ".gltf", ".npz", ".bvh", ".zip")


@dataclass(frozen=True)
class Stretch:
    """One labelled stretch of a take, in seconds from its first frame."""

    label: str
    start: float
    end: float


def labelled(folder: Path) -> dict[Path, Path]:
    """Every model of a folder that has labels beside it, by name: `take.glb` and `take.csv`."""
    found = {}
    for model in sorted(path for path in folder.iterdir() if path.suffix in MODELS):
        beside = [model.with_suffix(ending) for ending in ENDINGS]
        labels = next((path for path in beside if path.is_file()), None)
        if labels is not None:
            found[model] = labels
    return found


def read_labels(path: Path) -> list[Stretch]:
    """The labelled stretches of a file in order; ValueError where it cannot be one, or holds none."""
    reader = {".json": _from_json, ".csv": _from_csv, ".eaf": _from_eaf}[path.suffix]
    stretches = sorted(reader(path), key=lambda stretch: stretch.start)
    if not stretches:
        raise ValueError(f"{path.name} labels nothing")
    return stretches


def per_frame(stretches: list[Stretch], frames: int, frame_rate: float) -> Int[np.ndarray, "frames"]:
    """The label of every frame, by the time at its middle, numbered; what nobody labelled is a motion of its own."""
    middle = (np.arange(frames) + 0.5) / frame_rate
    numbers = {label: i for i, label in enumerate(dict.fromkeys(s.label for s in stretches))}
    labels = np.full(frames, len(numbers), np.int64)
    for stretch in stretches:
        labels[(middle >= stretch.start) & (middle < stretch.end)] = numbers[stretch.label]
    if labels[-1] == len(numbers):  # a truth may end a frame before the take does
        last = np.flatnonzero(labels < len(numbers))
        if len(last) and frames - last[-1] <= 2:
            labels[last[-1] :] = labels[last[-1]]
    return labels


def _from_json(path: Path) -> list[Stretch]:
    labelling = Labelling.of(json.loads(path.read_text(encoding="utf-8")))
    rate = labelling.frame_rate
    return [Stretch(label, start / rate, end / rate) for start, end, label in labelling.segments]


def _from_csv(path: Path) -> list[Stretch]:
    """With a header: `label`, `name` or `motion`, and `start_seconds`, `end_seconds`. More columns do not matter."""
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    if rows and not {"start_seconds", "end_seconds"} <= rows[0].keys():
        raise ValueError(f"{path.name} has no columns start_seconds and end_seconds")
    name = next((column for column in ("label", "name", "motion") if rows and column in rows[0]), None)
    if rows and name is None:
        raise ValueError(f"{path.name} has none of the columns label, name and motion")
    return [Stretch(row[str(name)], float(row["start_seconds"]), float(row["end_seconds"])) for row in rows]


def _from_eaf(path: Path) -> list[Stretch]:
    """The first tier of an ELAN file that has times. A DOCTYPE is refused: ELAN writes none, and they can be bombs."""
    data = path.read_bytes()
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise ValueError(f"{path.name} has a DOCTYPE, which no ELAN file has")
    root = ET.fromstring(data)
    slots = {slot.get("TIME_SLOT_ID"): slot.get("TIME_VALUE") for slot in root.iter("TIME_SLOT")}
    for tier in root.iter("TIER"):
        annotations = [
            (a.findtext("ANNOTATION_VALUE", ""), slots.get(a.get("TIME_SLOT_REF1")), slots.get(a.get("TIME_SLOT_REF2")))
            for a in tier.iter("ALIGNABLE_ANNOTATION")
        ]
        timed = [Stretch(label, int(a) / 1000, int(b) / 1000) for label, a, b in annotations if a and b]
        if timed:
            return timed
    return []
