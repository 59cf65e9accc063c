"""Labels of frames from a segmentation or a truth, and the agreement of two."""

import math
from dataclasses import dataclass
from typing import Any

from caesura.core.errors import InvalidModel

TOLERANCES_SECONDS = (0.5, 0.15)
MAX_FRAMES = 10**9
"""A year at 30 frames a second; the squares of counts of frames fit into 64 bits."""
MAX_LABELS = 1000
"""The best matching of labels takes O(labels³) time and O(labels²) memory."""


@dataclass(frozen=True)
class Labelling:
    """A motion for every frame, and the rate of the frames. Segments tile [0, frames)."""

    frame_rate: float
    frames: int
    segments: tuple[tuple[int, int, str], ...]
    start_seconds: float = 0.0

    def __post_init__(self) -> None:
        """Raises ValueError where it has too many frames or labels to be compared."""
        if self.frames > MAX_FRAMES or len({label for _, _, label in self.segments}) > MAX_LABELS:
            raise ValueError(f"it has more than {MAX_FRAMES} frames or {MAX_LABELS} labels")

    @classmethod
    def of(cls, document: dict[str, Any]) -> "Labelling":
        """The labelling that a parsed document states; raises ValueError where its segments do not tile it."""
        segments = tuple(
            (int(s["start"]), int(s["end"]), str(s["motion"] if "motion" in s else s["label"]))
            for s in document["segments"]
        )
        bounds = [0] + [end for _, end, _ in segments]
        if [start for start, _, _ in segments] != bounds[:-1] or bounds[-1] != int(document["frames"]):
            raise ValueError("the segments do not tile its frames")
        if not segments or any(start >= end for start, end, _ in segments):
            raise ValueError("it has no segments, or some without frames")
        rate = float(document["frame_rate"] if "frame_rate" in document else document["fps"])
        if not (math.isfinite(rate) and rate > 0):
            raise ValueError(f"{rate:g} frames a second are no frame rate")
        source = document.get("source")  # of a truth by others it may be where the take is from
        start = float(source.get("start_seconds", 0.0)) if isinstance(source, dict) else 0.0
        if not math.isfinite(start):
            raise ValueError(f"it starts at {start:g} seconds")
        return cls(rate, int(document["frames"]), segments, start)


def compute_agreement(found: Labelling, truth: Labelling) -> dict[str, float]:
    """Frame accuracy under the best matching of labels, the error of Eq. 6, Rand indices, boundary F1 by tolerance."""
    if (found.frames, found.frame_rate) != (truth.frames, truth.frame_rate):
        raise InvalidModel(
            "different-frames",
            f"The result has {found.frames} frames at {found.frame_rate:g} a second, the truth {truth.frames} at "
            f"{truth.frame_rate:g}. Compare results of the same take and frame rate.",
        )

    import numpy as np

    from caesura.core.agreement import adjusted_rand_index, boundary_scores, error_measure, frame_accuracy, rand_index

    ends = np.unique([end for of in (found, truth) for _, end, _ in of.segments])
    lengths = np.diff(ends, prepend=0)

    def labels(of: Labelling) -> Any:
        """The label of each run of frames in which neither changes."""
        names = {name: i for i, name in enumerate(dict.fromkeys(name for _, _, name in of.segments))}
        segments = np.searchsorted([end for _, end, _ in of.segments], ends)
        return np.array([names[name] for _, _, name in of.segments])[segments]

    def cuts(of: Labelling) -> Any:
        return np.array([start for start, _, _ in of.segments[1:]], np.int64)

    figures = {
        "frame_accuracy": float(frame_accuracy(labels(found), labels(truth), lengths)),
        "error_measure": float(error_measure(labels(found), labels(truth), lengths)),
        "rand_index": float(rand_index(labels(found), labels(truth), lengths)),
        "adjusted_rand_index": float(adjusted_rand_index(labels(found), labels(truth), lengths)),
    }
    for seconds in TOLERANCES_SECONDS:
        scores = boundary_scores(cuts(found), cuts(truth), round(seconds * truth.frame_rate))
        figures[f"boundary_f1_{seconds:g}_s"] = float(scores.f1)
    return figures
