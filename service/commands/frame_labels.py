"""Labels of frames from a segmentation or a truth, and the agreement of two."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
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

    @classmethod
    def read(cls, path: Path) -> "Labelling":
        """From a segmentation document or a truth: `segments` with start, end and `motion` or `label`."""
        try:
            with path.open(encoding="utf-8") as file:
                return cls.of(json.load(file))
        except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as wrong:
            # Of text that is none, repr would show all of it.
            said = str(wrong) if isinstance(wrong, ValueError) else repr(wrong)
            detail = f"{path} is neither a segmentation document nor a truth: {said}."
            raise InvalidModel("not-a-labelling", detail) from None

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
        if bounds[-1] > MAX_FRAMES or len({label for _, _, label in segments}) > MAX_LABELS:
            raise ValueError(f"it has more than {MAX_FRAMES} frames or {MAX_LABELS} labels")
        rate = float(document["frame_rate"] if "frame_rate" in document else document["fps"])
        if not (math.isfinite(rate) and rate > 0):
            raise ValueError(f"{rate:g} frames a second are no frame rate")
        return cls(rate, int(document["frames"]), segments)


def compute_agreement(found: Labelling, truth: Labelling) -> dict[str, float]:
    """Frame accuracy under the best matching of labels, adjusted Rand index, boundary F1 at each tolerance."""
    if (found.frames, found.frame_rate) != (truth.frames, truth.frame_rate):
        raise InvalidModel(
            "different-frames",
            f"The result has {found.frames} frames at {found.frame_rate:g} a second, the truth {truth.frames} at "
            f"{truth.frame_rate:g}. Compare results of the same take and frame rate.",
        )

    import numpy as np

    from caesura.core.agreement import adjusted_rand_index, boundary_scores, frame_accuracy

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
        "adjusted_rand_index": float(adjusted_rand_index(labels(found), labels(truth), lengths)),
    }
    for seconds in TOLERANCES_SECONDS:
        scores = boundary_scores(cuts(found), cuts(truth), round(seconds * truth.frame_rate))
        figures[f"boundary_f1_{seconds:g}_s"] = float(scores.f1)
    return figures
