"""Takes that nobody made for this: performed, played, and sheets of clips, with what is in them."""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.takes.labelled import MODELS
from benchmarks.takes.recordings import Recording
from benchmarks.takes.true_motions import TrueMotions
from caesura.core.analysis import Analysis
from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.formats.read import read_animation

KINDS = ("performed", "played", "sheets")
HALVES = ("development", "held out")


@dataclass(frozen=True)
class RealTake(TrueMotions):
    """A take, its true motions, and the document that tells them."""

    path: Path
    kind: str
    half: str
    document: dict[str, Any]

    def analysis(self, parameters: Parameters | None = None) -> Analysis:
        """The analysed take."""
        asked = parameters or Parameters()
        return analyse(self._animation(asked), asked)

    def recording(self) -> Recording:
        """The take as points over time, with the triangles between them where it has a surface."""
        animation = self._animation(Parameters())
        faces = animation.triangles if len(animation.triangles) else None
        return Recording(np.array(animation.vertices(0, animation.frames)), faces, animation.frame_rate)

    def _animation(self, asked: Parameters) -> Animation:
        data = {self.path.name: self.path.read_bytes()}
        return read_animation(data, asked, Limits.none(), lambda size: memoryview(bytearray(size)))


def real_takes(folder: Path) -> Iterator[RealTake]:
    """Every take of the folder, by kind and name."""
    for kind in KINDS:
        files = sorted(f for f in (folder / kind).iterdir() if f.suffix in MODELS)
        names = [re.sub(r"_\d+fps$", "", path.stem) for path in files]  # one take at two rates is one take
        for path, name in zip(files, names, strict=True):
            document = json.loads(path.with_suffix("").with_suffix(".truth.json").read_text())
            motions = list(dict.fromkeys(s["label"] for s in document["segments"]))
            truth = np.full(document["segments"][-1]["end"], -1)
            for segment in document["segments"]:
                truth[segment["start"] : segment["end"]] = motions.index(segment["label"])
            scored = truth >= 0
            for start, end in document.get("unlabelled", ()):
                scored[start:end] = False
            half = HALVES[sorted(set(names)).index(name) % 2]
            yield RealTake(truth, scored, path, kind, half, document)
