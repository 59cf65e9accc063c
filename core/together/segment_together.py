"""Several takes together: one set of motions over all of them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import ParameterError
from caesura.core.progress import Progress, ignore_progress
from caesura.core.segmentation import number_by_appearance
from caesura.core.single_threaded_blas import single_threaded_blas
from caesura.core.together.linkage import ALIKE, link_segments
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import (
    CollectedTake,
    MotionCollection,
    Told,
)
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.take_labelling import label_take
from caesura.core.together.take_segments import collect_segments, sign_take

MOST_LINKED = 2500
"""Segments that are linked at once, for linkage is quadratic (about 300 MB); takes beyond are labelled by the motions
found."""
MOST_APART = 4.0
"""Twice what two stretches at random are apart: no motion is farther from any."""


def segment_together(
    takes: Sequence[MeasuredTake], motions: Told = "auto", *, progress: Progress = ignore_progress
) -> MotionCollection:
    """One set of motions over all takes; each keeps its own cuts.

    `motions`: how many there are in all takes together, or "auto". Takes need not be equally long or fast, or of one
    performer, and a motion may be missing from most. The same answer in whatever order the takes come, but for the
    numbers of motions, which are in order of first appearance.

    Raises `InvalidModel` (`not-comparable`) saying which takes differ and in what, and `ParameterError` for no take,
    two of one name, or a number of motions that is not possible.
    """
    _check(takes, motions)
    progress("poses", 0.0)
    space = PoseSpace.learn([(take.name, take.poses) for take in takes])
    linked, later = _split(takes)
    collection = _link(space, linked, motions, progress)
    for i, take in enumerate(later):
        progress("further takes", i / len(later))
        collection = label_take(collection, take).collection
    return collection


def _split(takes: Sequence[MeasuredTake]) -> tuple[list[MeasuredTake], list[MeasuredTake]]:
    """Those that are linked at once, in order and evenly from all of them, and the others."""
    share = min(MOST_LINKED / sum(take.segments for take in takes), 1.0)
    chosen = np.diff(np.floor(np.arange(len(takes) + 1) * share + 1e-9)) > 0
    chosen[0] = True
    linked = [take for take, now in zip(takes, chosen, strict=True) if now]
    return linked, [take for take, now in zip(takes, chosen, strict=True) if not now]


def _link(space: PoseSpace, takes: Sequence[MeasuredTake], motions: Told, progress: Progress) -> MotionCollection:
    """The collection of takes whose segments are linked at once."""
    parts = []
    for i, take in enumerate(takes):
        progress("signatures", i / len(takes))
        parts.append(sign_take(space, take))
    signatures = MotionSignatures.joined(parts)
    segments = [segment for take in takes for segment in collect_segments(take)]
    spreads = signatures.spreads()
    progress("linkage", 0.0)
    with single_threaded_blas():
        distances = signatures.distances(signatures, spreads, space.signs)
        labels = link_segments(
            distances,
            np.repeat(np.arange(len(takes)), [take.segments for take in takes]),
            np.concatenate([take.motions for take in takes]),
            None if motions == "auto" else int(motions),
        )
        labels = number_by_appearance(labels)
        sure = rate_labels(distances, labels)
    return MotionCollection(
        space=space,
        takes=tuple(CollectedTake(take.name, take.poses.frames, take.poses.frame_rate) for take in takes),
        segments=tuple(
            replace(segment, motion=int(label), sure=certain)
            for segment, label, certain in zip(segments, labels, sure.tolist(), strict=True)
        ),
        signatures=signatures,
        names=(),
        spreads=spreads,
        alike=ALIKE,
        next_id=int(labels.max()) + 1,
    )


def rate_labels(distances: Float[np.ndarray, "n n"], labels: Int[np.ndarray, "n"]) -> Float[np.ndarray, "n"]:
    """How sure the motion of each segment is, 0 to 1: how much nearer it is, on average, than the next motion.

    A segment that is alone in its motion is measured against `ALIKE`, at which it would be none.
    """
    member = np.eye(int(labels.max()) + 1)[labels]
    counts = member.sum(axis=0)
    totals = distances @ member
    rows = np.arange(len(labels))
    others = counts[labels] - 1
    own = np.where(others > 0, totals[rows, labels] / np.maximum(others, 1), ALIKE)
    means = totals / counts
    means[rows, labels] = np.inf
    second = np.minimum(means.min(axis=1), MOST_APART)
    return np.asarray(np.clip((second - own) / second, 0.0, 1.0))


def _check(takes: Sequence[MeasuredTake], motions: Told) -> None:
    if not takes:
        raise ParameterError("no-takes", "There is no take: give at least one.", parameter="takes")
    names = [take.name for take in takes]
    for name in names:
        if names.count(name) > 1:
            raise ParameterError("same-name", f"Two takes are called {name!r}: give each a name of its own.")
    if motions != "auto" and motions < 1:
        raise ParameterError("invalid-parameter", f"motions = {motions} is not possible: it is auto, or 1 or more.")
