"""Figures 6 and 7: the paper's method beside spectral clustering, ACA and HACA, on trials of CMU 86, K told."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Int

from benchmarks.takes.cmu import annotation, skinned
from caesura.core.agreement import frame_accuracy, rand_index
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut

METHODS = ("haca", "aca", "joint-entropy", "spectral")
PUBLISHED = {"haca": 0.950, "aca": 0.942, "joint-entropy": 0.903, "spectral": 0.861}
"""The paper's means; ACA, HACA and spectral clustering on joint angles."""
SETS = ("strain", "strain,pair-distances")
SEEDS = 3


@dataclass(frozen=True)
class TrialRow:
    """One method on one trial by one set of descriptors: means over seeds, and the first seed's labels."""

    trial: str
    descriptors: str
    method: str
    rand: float
    accuracy: float
    labels: Int[np.ndarray, "frames"]
    truth: Int[np.ndarray, "frames"]


def measured(folder: Path) -> Iterator[TrialRow]:
    """Every trial of the folder; the paper's method from the first frame, at l = 1.3 s and ω = 2.0 s."""
    for motion in sorted(folder.glob("86_*.amc")):
        trial, annotated = motion.stem, annotation((folder / "mocap.txt").read_text(), motion.stem)
        take = skinned(folder, trial)
        truth = np.concatenate([annotated.frames, annotated.frames[-1:].repeat(take.frames)])[: take.frames]
        for chosen in SETS:
            analysis = analyse(take, Parameters(rest=0, descriptors=chosen), threads=2)
            for method in METHODS:
                asked = [Parameters(method=method, motions=annotated.motions, seed=seed) for seed in range(SEEDS)]
                labels = [cut(analysis, parameters).labels for parameters in asked]
                rand = float(np.mean([rand_index(found, truth) for found in labels]))
                accuracy = float(np.mean([frame_accuracy(found, truth) for found in labels]))
                yield TrialRow(trial, chosen, method, rand, accuracy, labels[0], truth)


def table(rows: list[TrialRow]) -> list[str]:
    """The Rand index, which is Eq. 6 as an accuracy, of every trial and the mean; then the order that was found."""
    trials = list(dict.fromkeys(row.trial for row in rows))
    lines = [
        f"| method | the paper's mean | descriptors | {' | '.join(trials)} | mean | frame accuracy |",
        "|---|---|---|" + "---|" * (len(trials) + 2),
    ]
    for chosen in SETS:
        means = {}
        for method in METHODS:
            of_it = [row for row in rows if (row.method, row.descriptors) == (method, chosen)]
            means[method] = float(np.mean([row.rand for row in of_it]))
            each = " | ".join(f"{row.rand:.3f}" for row in of_it)
            accuracy = np.mean([row.accuracy for row in of_it])
            lines.append(
                f"| `{method}` | {PUBLISHED[method]:.3f} | {chosen} | {each} | {means[method]:.3f} | {accuracy:.3f} |"
            )
        order = " > ".join(sorted(means, key=lambda name: -means[name]))
        lines.append(
            f"| order found | haca > aca > joint-entropy > spectral | {chosen} |{' |' * len(trials)} {order} | |"
        )
    return lines
