"""Labellings of a take: its motions and transitions as one view shows them, judged by the neighbour graph."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Int

from caesura.core.frames.blocks import map_blocks
from caesura.core.methods.switching.neighbour_graph import NeighbourGraph
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.subdivision import subdivide_motions
from caesura.core.methods.switching.transitions import remove_transitions
from caesura.core.methods.switching.views import View, Views

WORTH = 0.61
"""What a motion may add to the normalised cut where segments last a second. Where they last longer it is less, by the
root of their seconds: more of a short segment is near its ends, from where links lead out."""
SURENESS = 0.1
"""A subdivision must be cut so much less: it was looked for until something was found."""
BEFORE_REFINEMENT = 1.5
"""A subdivision that adds half more than it is worth before its cuts are refined, which takes time, adds too much
after."""


@dataclass(frozen=True)
class Labelling:
    """Labels of frames, the transitions that were taken out, the view they were found in, and their normalised cut.

    `cost` is what the view leaves unexplained. `segment_seconds`: how long a segment lasts in the mean. `subdivided`:
    how many motions were cut into two when seen by themselves.
    """

    labels: Int[np.ndarray, "frames"]
    transitions: tuple[tuple[int, int], ...]
    view: View
    cut: float
    motions: int
    cost: float
    segment_seconds: float
    subdivided: int = 0

    @property
    def rank(self) -> float:
        """By what labellings of as many motions are compared, the least first."""
        return self.cut + SURENESS * self.subdivided

    @property
    def worth(self) -> float:
        """What each of its motions may add to the normalised cut."""
        return WORTH / float(np.sqrt(self.segment_seconds))


@dataclass(frozen=True)
class Labellings:
    """The labellings of a take, each worked out when it is first asked for."""

    views: Views
    refinement: Refinement
    threads: int = 1
    _known: dict[tuple[View, int], Labelling] = field(default_factory=dict)
    _divided: dict[bytes, tuple[Labelling, ...]] = field(default_factory=dict)

    @cached_property
    def graph(self) -> NeighbourGraph:
        """What judges them."""
        return NeighbourGraph.of(self.refinement.poses, self.refinement.frame_rate, self.threads)

    def prepare(self, asked: Iterable[tuple[View, int]]) -> None:
        """Work out several labellings side by side."""
        missing = [one for one in asked if one not in self._known]
        for _ in map_blocks(lambda one: self.labelling(*one), missing, min(self.threads, len(missing))):
            pass

    def labelling(self, view: View, motions: int) -> Labelling:
        """The take cut into so many motions in one view, or fewer: transitions are none."""
        if (view, motions) not in self._known:
            viewed = self.views.by(view)
            settled = viewed.settled(motions)
            self._known[view, motions] = self._judged(view, viewed.signal.per_frame(settled.labels), settled.cost)
        return self._known[view, motions]

    def subdivisions(self, whole: Labelling) -> tuple[Labelling, ...]:
        """The labelling with one of its motions cut into two, each in turn, where that leaves more motions."""
        key = whole.labels.tobytes()
        if key not in self._divided:
            divided = subdivide_motions(whole.labels, self.views, self.threads)
            most = whole.cut + BEFORE_REFINEMENT * whole.worth
            promising = [one for one in divided if self.graph.cut(one[1]) < most]
            judged = map_blocks(
                lambda one: self._judged(*one, whole.cost, whole.subdivided + 1), promising, self.threads
            )
            self._divided[key] = tuple(
                found
                for found in judged
                if found.motions > whole.motions and found.segment_seconds < whole.segment_seconds
            )
        return self._divided[key]

    def _judged(self, view: View, labels: Int[np.ndarray, "frames"], cost: float, subdivided: int = 0) -> Labelling:
        refined = self.refinement.moved(labels)
        cleared = remove_transitions(refined, self.views.frames.frame_rate)
        count = len(np.unique(cleared.labels))
        segments = int(np.count_nonzero(np.diff(cleared.labels))) + 1
        seconds = len(labels) / self.refinement.frame_rate / segments
        cut = self.graph.cut(cleared.labels)
        return Labelling(cleared.labels, cleared.transitions, view, cut, count, cost, seconds, subdivided)
