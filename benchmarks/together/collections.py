"""Takes of one body with true labels, as a collection sees them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Int

from benchmarks.takes.real import RealTake, real_takes
from caesura.api import open_animation
from caesura.core.agreement import frame_accuracy
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.core.together.measured_take import MeasuredTake, measure_take
from caesura.core.together.motion_collection import MotionCollection
from caesura.core.together.segment_together import segment_together

PERFORMED = {
    "exercises, visits (s01 to s04)": r"exercises_s\d\d",
    "exercises, all ten (s01, s02)": r"exercises_ten_s\d\d",
    "exercises, all six takes": r"exercises_.*",
    "mocap6 (13_30, 14_14)": r"1[34]_\d\d_30fps",
    "mocap6 with CMU 86": r"\d\d_\d\d_30fps",
}
"""Names of collections, and the files that each is of."""


@dataclass(frozen=True)
class KnownTake:
    """A take as it is compared, the true label of every frame ("" where nobody knows it), and its truth."""

    measured: MeasuredTake
    truth: Int[np.ndarray, "frames"]
    document: dict[str, Any]

    @classmethod
    def of(cls, take: RealTake, motions: int | None = None) -> "KnownTake":
        """Cut alone by the default method, with or without its own number of motions."""
        animation = open_animation(take.path)
        found = cut(analyse(animation), Parameters(motions=motions or "auto"))
        truth = np.full(animation.frames, "", object)
        for segment in take.document["segments"]:
            truth[segment["start"] : segment["end"]] = segment["label"]
        scored = np.zeros(animation.frames, bool)
        scored[: len(take.scored)] = take.scored[: animation.frames]
        measured = measure_take(take.path.stem, animation, found.segments)
        return cls(measured, np.where(scored, truth, "").astype(str), take.document)

    @property
    def own_labels(self) -> Int[np.ndarray, "frames"]:
        """The labels of the take cut alone."""
        return np.repeat(self.measured.motions, np.diff(self.measured.bounds))

    def accuracy(self, labels: Int[np.ndarray, "frames"]) -> float:
        """Frame accuracy of the take by itself."""
        scored = self.truth != ""
        return frame_accuracy(labels[scored], np.unique(self.truth[scored], return_inverse=True)[1])


def performed_takes(folder: Path) -> dict[str, KnownTake]:
    """Every performed take of the folder at 25 or 30 frames a second, cut alone, by name."""
    takes = (take for take in real_takes(folder) if take.kind == "performed" and "120fps" not in take.path.name)
    return {take.path.stem: KnownTake.of(take) for take in takes}


def joint_accuracy(takes: Sequence[KnownTake], collection: MotionCollection) -> float:
    """Frame accuracy over all takes, under one matching of labels."""
    truth = np.concatenate([take.truth for take in takes])
    labels = np.concatenate([collection.labels(take.measured.name) for take in takes])
    scored = truth != ""
    return frame_accuracy(labels[scored], np.unique(truth[scored], return_inverse=True)[1])


def true_motions(takes: Sequence[KnownTake]) -> int:
    """How many there truly are in all takes together."""
    return len(set(np.concatenate([take.truth for take in takes]).tolist()) - {""})


def segment_labels(take: KnownTake) -> list[str]:
    """The most frequent true label of each segment that was found."""
    found = []
    bounds = take.measured.bounds.tolist()
    for start, end in pairwise(bounds):
        names, counts = np.unique(take.truth[start:end], return_counts=True)
        found.append(str(names[counts.argmax()]))
    return found


def labelled_collection(takes: Sequence[KnownTake]) -> MotionCollection:
    """The takes with every segment labelled as a person would, each motion named."""
    collection = segment_together([take.measured for take in takes])
    labels = [label for take in takes for label in segment_labels(take)]
    names = sorted(set(labels))
    return replace(
        collection,
        segments=tuple(
            replace(segment, motion=names.index(label))
            for segment, label in zip(collection.segments, labels, strict=True)
        ),
        names=tuple(enumerate(names)),
        next_id=len(names),
    )
