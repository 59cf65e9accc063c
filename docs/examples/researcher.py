"""Arrays in; energy curve, key-frames and labels out; and four ways to cut the same take beside its truth.

    python docs/examples/researcher.py energy.csv

The take is a figure of the project's own, whose motions are known. Yours would come from numpy.load: vertices
(frames, V, 3) and triangles (T, 3).
"""

import sys
from pathlib import Path

import numpy as np
from sklearn.cluster import KMeans
from sklearn.metrics import adjusted_rand_score
from sklearn.pipeline import make_pipeline

from caesura import MotionFeatures, MotionSegmenter, open_animation, segment
from caesura.samples.figures import figure


def main(table: Path) -> None:
    """Write the energy curve as CSV, and print how well each method agrees with the truth."""
    sample = figure("smooth")
    take = open_animation(sample.glb)
    vertices, triangles = np.array(take.vertices(0, take.frames)), take.triangles
    names = [label for label, start, end in sample.truth.segments for _ in range(start, end)]
    truth = np.unique(names, return_inverse=True)[1]
    motions = int(truth.max()) + 1

    # The paper's own measurements: the energy of every frame (NaN where its windows do not fit) and the key-frames.
    paper = segment(vertices, triangles, frame_rate=take.frame_rate, rest_shape=take.rest, method="joint-entropy",
                    motions=motions, window_seconds=1.3)  # fmt: skip
    rows = np.column_stack([np.arange(take.frames), paper.energy, paper.labels])
    np.savetxt(table, rows, fmt=["%d", "%.6f", "%d"], delimiter=",", header="frame,energy,label", comments="")
    print(f"{len(paper.key_frames)} key-frames: {', '.join(map(str, paper.key_frames))}")

    # The same take, each method told the number of motions; the last is k-means of single frames, as a base line.
    methods = {
        "joint-entropy": MotionSegmenter(motions, method="joint-entropy"),
        "switching": MotionSegmenter(motions),
        "spectral": MotionSegmenter(motions, method="spectral"),
        "k-means": make_pipeline(MotionFeatures(), KMeans(motions, n_init=4, random_state=0)),
    }
    print(f"Adjusted Rand index, {motions} motions, {take.frames} frames:")
    for name, method in methods.items():
        print(f"  {name:<14} {adjusted_rand_score(truth, method.fit_predict(take)):.3f}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
