"""Takes that nobody made for this: performed, played, and sheets of clips, with what is in them."""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Int

from benchmarks.takes.labelled import MODELS
from caesura.core.agreement import frame_accuracy
from caesura.core.analysis import Analysis
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.formats.read import read_animation

KINDS = ("performed", "played", "sheets")
HALVES = ("development", "held out")


@dataclass(frozen=True)
class RealTake:
    """A take, its true motion per frame, which frames are scored, and the document of its truth."""

    path: Path
    kind: str
    half: str
    truth: Int[np.ndarray, "frames"]
    scored: Bool[np.ndarray, "frames"]
    document: dict[str, Any]

    @property
    def motions(self) -> int:
        """How many there truly are."""
        return len(np.unique(self.truth[self.scored]))

    def analysis(self, parameters: Parameters | None = None) -> Analysis:
        """The analysed take."""
        data, asked = {self.path.name: self.path.read_bytes()}, parameters or Parameters()
        animation = read_animation(data, asked, Limits.none(), lambda size: memoryview(bytearray(size)))
        return analyse(animation, asked)

    def accuracy(self, labels: Int[np.ndarray, "frames"]) -> float:
        """Frame accuracy over the scored frames."""
        return frame_accuracy(labels[self.scored], self.truth[self.scored])


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
            yield RealTake(path, kind, half, truth, scored, document)
