"""Are these the methods of their authors? Theirs on their own features, beside the figures their own program gave.

    python -m benchmarks.paper.aca_authors --cmu ../shared/data/cmu86 --seeds 10

Two trials of CMU subject 86, 120 frames a second, the number of motions told, the parameters their program has. Frame
accuracy under the best matching of labels, on reduced frames as they count; mean and standard deviation over seeds. A
row `as measured` has the lengths of first segments as their program takes them
(see `caesura.core.kernels.alignment.pure_segments`),
the row above as their papers say, which is what `method=aca` and `method=haca` do. Writes its table into
docs/accuracy.md, or with `--print` not.
"""

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from threadpoolctl import threadpool_limits

from benchmarks.reports.report import ACCURACY, write_section
from benchmarks.takes.joint_angles import joint_angles, true_motions
from caesura.core.agreement import frame_accuracy
from caesura.core.methods.alignment.cluster_analysis import cluster_by_alignment
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.hierarchy import cluster_in_two_levels
from caesura.core.methods.alignment.initial_segmentation import InitialSegmenter
from caesura.core.methods.alignment.segments import SegmentLengths
from caesura.core.methods.alignment.short_runs import remove_short_runs
from caesura.core.methods.alignment.spectral_clustering import cluster_spectrally
from caesura.core.methods.alignment.temporal_reduction import reduce_frames

TRIALS = ("86_01", "86_09")
REDUCED_BY = 5
SEGMENTS = SegmentLengths(32, 60)
MOVES, ABOVE = SegmentLengths(8, 10), SegmentLengths(4, 6)

Kernel = Float[np.ndarray, "samples samples"]
Labels = Int[np.ndarray, "samples"]
Method = Callable[[Kernel, int, int], Labels]

AUTHORS: dict[str, tuple[tuple[float, float | None], ...]] = {
    "spectral": ((0.797, None), (0.909, None)),
    "aca": ((0.904, 0.002), (0.931, 0.021)),
    "haca": ((0.934, 0.030), (0.956, 0.017)),
}
"""Mean and standard deviation over 10 seeds of the authors' own program, on `TRIALS`."""


def spectral(kernel: Kernel, motions: int, seed: int) -> Labels:
    """Spectral clustering, no run below 32 samples."""
    return remove_short_runs(cluster_spectrally(kernel, motions, seed), SEGMENTS.shortest)


def aca(as_measured: bool) -> Method:
    """Segments of 32 to 60 samples, one initial segmentation."""

    def divide(kernel: Kernel, motions: int, seed: int) -> Labels:
        first = InitialSegmenter.of(kernel, np.ones(len(kernel)), motions, SEGMENTS, as_measured=as_measured)
        return cluster_by_alignment(kernel, first.weights, first.start(seed), first.lengths.longest).segments.per_sample

    return divide


def haca(as_measured: bool) -> Method:
    """Moves of 8 to 10 samples, motions of 4 to 6 moves."""
    return lambda kernel, motions, seed: (
        cluster_in_two_levels(kernel, motions, MOVES, ABOVE, seed, as_measured=as_measured).per_sample
    )


METHODS: dict[tuple[str, str], Method] = {
    ("spectral", ""): spectral,
    ("aca", ""): aca(as_measured=False),
    ("aca", "as measured"): aca(as_measured=True),
    ("haca", ""): haca(as_measured=False),
    ("haca", "as measured"): haca(as_measured=True),
}


def accuracies(folder: Path, trial: str, seeds: int) -> Iterator[tuple[tuple[str, str], list[float]]]:
    """The accuracy of every method for every seed."""
    features = joint_angles((folder / f"{trial}.amc").read_text())
    truth = true_motions(folder / "mocap.txt", trial)
    reduced = [reduce_frames(features, REDUCED_BY, seed) for seed in range(seeds)]
    kernels = [frame_kernel(blocks.of(features)) for blocks in reduced]
    # A cut inside a block counts from the block's start: so a block is of the motion that its last frame is of.
    truths = [truth[blocks.bounds[1:] - 1] for blocks in reduced]
    motions = len(np.unique(truth))
    for name, method in METHODS.items():
        found = [method(kernel, motions, seed) for seed, kernel in enumerate(kernels)]
        yield name, [frame_accuracy(labels, true) for labels, true in zip(found, truths, strict=True)]


def row(trial: str, name: tuple[str, str], found: list[float]) -> str:
    """One line: ours, theirs, and whether the means agree to a standard deviation of theirs or 0.02."""
    mean, deviation = float(np.mean(found)), float(np.std(found, ddof=1)) if len(found) > 1 else 0.0
    theirs, spread = AUTHORS[name[0]][TRIALS.index(trial)]
    beside = f"{theirs:.3f}" + (f" ± {spread:.3f}" if spread is not None else "")
    near = abs(mean - theirs) <= max(spread or 0.0, 0.02)
    ours = f"{mean:.3f} ± {deviation:.3f}"
    return f"{trial}  {name[0]:8}  {name[1]:11}  {ours:13}  {beside:13}  {'yes' if near else f'{mean - theirs:+.3f}'}"


def main() -> None:
    """Prints the table, a line as soon as it is known, and writes it."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--cmu", type=Path, required=True, help="folder of 86_01.amc, 86_09.amc and mocap.txt")
    options.add_argument("--seeds", type=int, default=10)
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    lines = ["trial  method    first cuts   ours           authors        agree"]
    print(lines[0])
    with threadpool_limits(1):
        for trial in TRIALS:
            for name, found in accuracies(given.cmu, trial, given.seeds):
                lines.append(row(trial, name, found))
                print(lines[-1], flush=True)
    if not given.print:
        write_section(ACCURACY, "authors", "\n".join(["```", *lines, "```"]))


if __name__ == "__main__":
    main()
