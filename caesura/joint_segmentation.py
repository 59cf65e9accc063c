"""Several takes together, for programs: one set of motions over all of them, takes added, and search by example."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from jaxtyping import Int
from numpy.typing import ArrayLike

from caesura.api import open_animation
from caesura.core.animation import Animation
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment as segment_animation
from caesura.core.progress import Progress, ignore_progress
from caesura.core.together import segment_together as together
from caesura.core.together.body_poses import measure_poses
from caesura.core.together.collection_file import collection_from_bytes, collection_to_bytes
from caesura.core.together.example_search import ExampleIndex, FoundRange, cut_example, index_take
from caesura.core.together.measured_take import MeasuredTake, measure_take
from caesura.core.together.motion_collection import CommonMotion, MotionCollection, Told
from caesura.core.together.take_labelling import label_take
from caesura.file_sources import FileSources, file_name

Take: TypeAlias = Animation | FileSources | ArrayLike

OF_ARRAYS = ("triangles", "frame_rate", "rest_shape")
"""What `open_animation` takes beside parameters."""


@dataclass(frozen=True)
class JointSegmentation:
    """The motions of several takes: `collection` says which segment is of which, `takes` are what is searched."""

    collection: MotionCollection
    takes: tuple[MeasuredTake, ...]

    @property
    def motions(self) -> tuple[CommonMotion, ...]:
        """Every motion: its id and name, seconds, number of segments and takes, and the segment most like all."""
        return self.collection.motions

    def labels(self, take: str) -> Int[np.ndarray, "frames"]:
        """The id of the motion of every frame of a take."""
        return self.collection.labels(take)

    def rename(self, motion: int, name: str) -> "JointSegmentation":
        """The same with a motion named."""
        return JointSegmentation(self.collection.with_name(motion, name), self.takes)

    def add(self, source: Take, name: str | None = None, *, threads: int = 1, **parameters: Any) -> "JointSegmentation":
        """The same with one take more, labelled by the motions that are known; what is none of them is new."""
        measured = _measure(source, name or _name_of(source), threads, ignore_progress, parameters)
        return JointSegmentation(label_take(self.collection, measured).collection, (*self.takes, measured))

    def find(self, take: str, start: int, end: int, most: int = 50, *, threads: int = 1) -> tuple[FoundRange, ...]:
        """The ranges of all takes most like frames [start, end) of one of them, the nearest first."""
        return self.index.find(self.index.example(take, start, end), most, threads=threads)

    def find_example(
        self,
        source: Take,
        most: int = 50,
        *,
        start: float = 0.0,
        end: float | None = None,
        threads: int = 1,
        **parameters: Any,
    ) -> tuple[FoundRange, ...]:
        """The ranges of all takes most like another take, or like its seconds `start` to `end`, the nearest first.

        Of a part the whole take is looked at, for a performer's stance is told by it.
        """
        animation = open_animation(source, **parameters)
        indexed = index_take(self.index.space, "the example", measure_poses(animation))
        first = round((start - animation.start_seconds) * animation.frame_rate) if start else 0
        last = animation.frames if end is None else round((end - animation.start_seconds) * animation.frame_rate)
        return self.index.find(cut_example(indexed, first, min(last, animation.frames)), most, threads=threads)

    @cached_property
    def index(self) -> ExampleIndex:
        """What a search goes through."""
        return ExampleIndex.of(self.collection.space, [(take.name, take.poses) for take in self.takes])

    def to_bytes(self) -> bytes:
        """All of it as an NPZ of plain arrays, nothing pickled."""
        out = io.BytesIO()
        parts: dict[str, Any] = {f"take_{i}": _bytes(take.to_bytes()) for i, take in enumerate(self.takes)}
        np.savez(out, collection=_bytes(collection_to_bytes(self.collection)), **parts)
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "JointSegmentation":
        """What `to_bytes` wrote."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            collection = collection_from_bytes(stored["collection"].tobytes())
            count = len(stored.files) - 1
            takes = tuple(MeasuredTake.from_bytes(stored[f"take_{i}"].tobytes()) for i in range(count))
        return cls(collection, takes)


def segment_together(
    sources: Mapping[str, Take] | Sequence[Take],
    motions: Told = "auto",
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
    **parameters: Any,
) -> JointSegmentation:
    """One set of motions over several takes of one body: the same topology, or the same skeleton by names of joints.

        found = segment_together(["monday.glb", "tuesday.glb"])
        found.labels("monday"), found.motions, found.find("monday", 0, 90)

    `sources` are takes by name, or files in a list, which are called as they are without their endings. Each is cut
    alone with the `parameters` of `segment`; `motions` is the number of motions of all together, or "auto". Of arrays
    (frames, V, 3), `triangles`, `frame_rate` and `rest_shape` are those of all takes.

    Raises `CaesuraError`: `InvalidModel` (`not-comparable`) saying which takes differ and in what, and what `segment`
    raises.
    """
    named = dict(sources) if isinstance(sources, Mapping) else _by_name(sources)
    takes = []
    for i, (name, source) in enumerate(named.items()):
        progress(f"take {i + 1} of {len(named)}", i / len(named))
        takes.append(_measure(source, name, threads, ignore_progress, parameters))
    return JointSegmentation(together.segment_together(takes, motions, progress=progress), tuple(takes))


def _measure(source: Take, name: str, threads: int, progress: Progress, parameters: Mapping[str, Any]) -> MeasuredTake:
    animation = open_animation(source, **parameters)
    chosen = {name: value for name, value in parameters.items() if name not in OF_ARRAYS}
    found = segment_animation(animation, Parameters.parse(chosen), threads=threads, progress=progress)
    return measure_take(name, animation, found.segments)


def _by_name(sources: Sequence[Take]) -> dict[str, Take]:
    named = {_name_of(source): source for source in sources}
    if len(named) < len(sources):
        detail = "Two of the files have one name: give them by names of your own, as a mapping."
        raise ParameterError("same-name", detail, parameter="sources")
    return named


def _name_of(source: Take) -> str:
    name = Path(file_name(source)).stem
    if not name:
        detail = "A take of arrays or bytes has no name: give takes by name, as a mapping."
        raise ParameterError("missing-parameter", detail, parameter="sources")
    return name


def _bytes(data: bytes) -> np.ndarray:
    return np.frombuffer(data, np.uint8)
