"""Barbič's three methods on trials of CMU 86, on joint quaternions at 120 frames a second, as in their paper.

A cut is right where it lies in the accepted range of a true one, each range counted once.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.transform import Rotation

from benchmarks.takes.cmu import STEP, annotation
from benchmarks.takes.joint_angles import joint_angles
from caesura.core.agreement import cut_frames
from caesura.core.methods.alignment.short_runs import remove_short_runs
from caesura.core.methods.barbic2004.gmm import SHORTEST_SECONDS, label_by_mixture
from caesura.core.methods.barbic2004.pca import find_pca_bounds
from caesura.core.methods.barbic2004.ppca import find_ppca_bounds

RATE = 120.0
HEAD = ("| method | trial | cuts found | true cuts | precision | recall |", "|---|---|---|---|---|---|")


def quaternions(motion: str) -> Float[np.ndarray, "frames 56"]:
    """Of fourteen joints, none of them the root; of the two that say the same, that with the positive real part."""
    turns = 2 * joint_angles(motion).reshape(-1, 3)
    found = Rotation.from_rotvec(turns).as_quat(canonical=True)
    return np.asarray(found.reshape(-1, 56))


def cuts_of(values: Float[np.ndarray, "frames 56"], motions: int) -> dict[str, Int[np.ndarray, "cuts"]]:
    """The cuts of each method; the mixture is told K, the others nothing."""
    labels = remove_short_runs(label_by_mixture(values, motions, 0), round(SHORTEST_SECONDS * RATE))
    return {
        "pca": find_pca_bounds(values, RATE)[1:-1],
        "ppca": find_ppca_bounds(values, RATE)[1:-1],
        "gmm": cut_frames(labels),
    }


def rows(folder: Path) -> Iterator[str]:
    """A line for every trial and method, and the sum of each method."""
    sums: dict[str, list[tuple[int, int, int]]] = {}
    for motion in sorted(folder.glob("86_*.amc")):
        truth = annotation((folder / "mocap.txt").read_text(), motion.stem)
        ranges = [(STEP * first, STEP * last) for first, last in truth.ranges[:-1]]
        for method, cuts in cuts_of(quaternions(motion.read_text()), truth.motions).items():
            hits = sum(bool(((first <= cuts) & (cuts <= last)).any()) for first, last in ranges)
            sums.setdefault(method, []).append((len(cuts), len(ranges), hits))
            yield _line(method, motion.stem, len(cuts), len(ranges), hits)
    for method, counts in sums.items():
        yield _line(method, "all", *(sum(count) for count in zip(*counts, strict=True)))


def _line(method: str, trial: str, found: int, true: int, hits: int) -> str:
    return f"| `{method}` | {trial} | {found} | {true} | {hits / max(found, 1):.2f} | {hits / max(true, 1):.2f} |"
