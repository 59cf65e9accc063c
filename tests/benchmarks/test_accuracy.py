"""The table of accuracies: the truth of every frame, and a line for every take and method."""

import subprocess
import sys

import numpy as np
import pytest

from benchmarks.takes.sequences import truth_of
from caesura.core.analysis import Analysis
from caesura.core.segmentation_document import Source

DOCUMENT = {
    "fps": 30,
    "frames": 60,
    "segments": [
        {"label": "walk", "start": 0, "end": 20},
        {"label": "run", "start": 20, "end": 50},
        {"label": "walk", "start": 50, "end": 60},
    ],
}


def analysis(frames, rate):
    none = np.zeros(0)
    return Analysis(
        frames, rate, Source(take=0, name="take", fps=rate), {}, np.zeros(frames), none.astype(np.int64),
        np.zeros((0, 0), np.float32), (), 1.0,
    )  # fmt: skip


@pytest.mark.parametrize(("frames", "rate", "ends"), [(60, 30.0, (20, 50, 60)), (119, 60.0, (40, 100, 119))])
def test_the_truth_is_read_at_the_rate_of_the_take(frames, rate, ends):
    """At twice the frame rate every true cut is at twice the frame; a label that returns is the same motion."""
    truth = truth_of(DOCUMENT, analysis(frames, rate))
    assert (np.flatnonzero(np.diff(truth)) + 1).tolist() == list(ends[:-1])
    assert truth[0] == truth[-1] != truth[ends[0]]


def test_the_default_method_finds_the_shared_takes(shared):
    """Told K, at least 0.985 of the frames are right in the mean; not told, 0.95; and far more than by single poses."""
    command = [sys.executable, "-m", "benchmarks.accuracy", str(shared / "data" / "takes")]
    command += ["--methods", "switching,joint-entropy", "--peer-names", "", "--print"]
    run = subprocess.run(command, capture_output=True, text=True, timeout=200, check=True)
    means = {
        (line.split()[5], line.split()[6]): float(line.split()[8])
        for line in run.stdout.splitlines()
        if line.startswith("mean of 5 in all")
    }
    assert means["switching", "K"] >= 0.985
    assert means["switching", "auto"] >= 0.95
    assert means["switching", "K"] > means["joint-entropy", "K"] + 0.2
