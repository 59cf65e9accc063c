"""The sample files that the page offers to try, and the short performance that its first screen shows."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from caesura.samples.figure_glb import smooth_glb
from caesura.samples.long_session import long_session
from caesura.samples.performed_take import RATE, Part, Sample, perform_take
from caesura.samples.repertoire import MOTIONS
from caesura.samples.sample_figures import build_figure
from caesura.samples.smooth_body import build_body

INDEX = "samples.json"
SESSION_FRAMES = 5400
SHORT_PERFORMANCE = (("walk", 2), ("wave", 3), ("squat", 1), ("walk", 2), ("jump", 1), ("clap", 3))
SEED = 4


@dataclass(frozen=True)
class SampleFile:
    """A file that people may try: its name, what the page says of it, and what makes it."""

    file: str
    title: str
    description: str
    build: Callable[[], Sample]

    def write(self, folder: Path) -> dict[str, Any]:
        """Write the file; answers its entry of the index, with what is performed in it."""
        sample = self.build()
        (folder / self.file).write_bytes(sample.glb)
        return {
            "file": self.file,
            "title": self.title,
            "description": self.description,
            "frames": sample.truth.frames,
            "frame_rate": sample.truth.fps,
            "segments": _numbered_segments(sample),
        }


def _numbered_segments(sample: Sample) -> list[dict[str, Any]]:
    """Name, motion and frames of each, motions numbered by first appearance."""
    names = list(dict.fromkeys(name for name, _, _ in sample.truth.segments))
    return [
        {"name": name, "motion": names.index(name), "start": start, "end": end}
        for name, start, end in sample.truth.segments
    ]


def build_short_performance() -> Sample:
    """A few seconds of five motions by the smooth figure."""
    random = np.random.default_rng(SEED)
    motions = [(MOTIONS[name], times) for name, times in SHORT_PERFORMANCE]
    take = perform_take([Part(motion, motion.ends(times, RATE, random)) for motion, times in motions], random)
    return Sample(smooth_glb(build_body(), take), take.truth)


DEMONSTRATION = SampleFile("demonstration.glb", "A short performance", "", build_short_performance)

SAMPLE_FILES = (
    SampleFile("person.glb", "A person", "walks, waves, squats, jumps and claps", lambda: build_figure("smooth")),
    SampleFile("robot.glb", "A robot", "rigid parts that march, punch, kick and bow", lambda: build_figure("rigid")),
    SampleFile(
        "session.glb",
        "A capture session",
        "a T-pose, many motions, pauses and retakes",
        lambda: long_session(SESSION_FRAMES),
    ),
)


def write_sample_files(folder: Path) -> None:
    """Write all of them into a folder, and `samples.json`, which says what is in each. The same bytes at every call."""
    folder.mkdir(parents=True, exist_ok=True)
    index = {
        "demonstration": DEMONSTRATION.write(folder),
        "samples": [sample.write(folder) for sample in SAMPLE_FILES],
    }
    (folder / INDEX).write_text(json.dumps(index), encoding="utf-8")
