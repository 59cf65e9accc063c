"""The number of motions: of what the views found, the labelling of the least normalised cut, and how many it has."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Int

from caesura.core.agreement import adjusted_rand_index
from caesura.core.methods.switching.neighbour_graph import NeighbourGraph
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.transitions import remove_transitions
from caesura.core.methods.switching.views import View, Views

WORTH = 0.34
"""What one motion more may add to the normalised cut. A true motion adds less than .3 on nine takes of ten, the half of
one more than .4."""
BEYOND = 4
"""So many more motions are asked of a view than are to be found, for some of them may be transitions."""
PATIENCE = 5
AROUND = 2
NEAR = 0.1
MOST_VOTES = 20
MOST = 200


@dataclass(frozen=True)
class Labelling:
    """Labels of frames, the transitions that were taken out, the view they were found in, and their normalised cut.

    `cost` is what the view leaves unexplained.
    """

    labels: Int[np.ndarray, "frames"]
    transitions: tuple[tuple[int, int], ...]
    view: View
    cut: float
    motions: int
    cost: float


@dataclass(frozen=True)
class Labellings:
    """The labellings of a take, each worked out when it is first asked for."""

    views: Views
    refinement: Refinement
    _known: dict[tuple[View, int], Labelling] = field(default_factory=dict)

    @cached_property
    def graph(self) -> NeighbourGraph:
        """What judges them."""
        return NeighbourGraph.of(self.refinement.poses, self.refinement.frame_rate)

    def labelling(self, view: View, motions: int) -> Labelling:
        """The take cut into so many motions in one view, or fewer: transitions are none."""
        if (view, motions) not in self._known:
            viewed = self.views.by(view)
            settled = viewed.settled(motions)
            refined = self.refinement.moved(viewed.signal.per_frame(settled.labels))
            cleared = remove_transitions(refined, self.views.frames.frame_rate)
            count = len(np.unique(cleared.labels))
            cut = self.graph.cut(cleared.labels)
            self._known[view, motions] = Labelling(cleared.labels, cleared.transitions, view, cut, count, settled.cost)
        return self._known[view, motions]


@dataclass(frozen=True)
class MotionCountSearch:
    """One search for the best labelling: `found` are those that it looked at, whatever others did before."""

    labellings: Labellings
    found: dict[tuple[View, int], Labelling] = field(default_factory=dict)

    @property
    def views(self) -> tuple[View, ...]:
        """The views that show something."""
        return self.labellings.views.names

    def ask(self, views: Iterable[View], motions: int) -> None:
        """Look at so many motions in each view."""
        for view in views:
            self.found[view, motions] = self.labellings.labelling(view, motions)

    def best(self) -> dict[int, Labelling]:
        """For every number of motions that was found the labelling of the least normalised cut, the first of equals."""
        best: dict[int, Labelling] = {}
        for labelling in self.found.values():
            if labelling.motions not in best or labelling.cut < best[labelling.motions].cut - EQUAL:
                best[labelling.motions] = labelling
        return dict(sorted(best.items()))

    def of(self, motions: int) -> Labelling:
        """The best labelling of so many motions, or of as many as there can be."""
        for view in self.views:
            for more in range(BEYOND + 1):
                self.ask((view,), motions + more)
                if self.found[view, motions + more].motions >= motions:
                    break
        best = self.best()
        return self._agreed(max((count for count in best if count <= motions), default=min(best)))

    def choose(self) -> Labelling:
        """The labelling of the number of motions that is worth most: the least normalised cut − `WORTH` · motions.

        One view tells about how many there are, and all of them which.
        """
        lead = self.views[:1]
        for motions in range(1, MOST + 1):
            self.ask(lead, motions)
            if motions >= _worthiest(self.best()).motions + PATIENCE:
                break
        tried = 0
        while (now := _worthiest(self.best()).motions) != tried:
            tried = now
            for motions in range(max(now - AROUND, 1), now + BEYOND + 1):
                self.ask(self.views, motions)
        return self._agreed(_worthiest(self.best()).motions)

    def _agreed(self, motions: int) -> Labelling:
        """Of the labellings of so many motions hardly cut more than the best, that which agrees most with them.

        Where one view moves a cut or splits a motion, the others seldom do it in the same way.
        """
        least = self.best()[motions].cut
        near = [found for found in self.found.values() if found.motions == motions and found.cut <= least + NEAR]
        near = sorted(near, key=lambda found: found.cut)[:MOST_VOTES]
        agreement = [sum(adjusted_rand_index(one.labels, other.labels) for other in near) for one in near]
        return near[int(np.argmax(np.array(agreement) >= max(agreement) - EQUAL))]

    def scores(self) -> tuple[tuple[int, float], ...]:
        """What each number of motions tried leaves unexplained in the first view, as a share of what one does."""
        costs = [labelling.cost for (view, _), labelling in self.found.items() if view == self.views[0]]
        return tuple((i + 1, min(cost / (costs[0] or 1.0), 1.0)) for i, cost in enumerate(costs))


EQUAL = 1e-9


def _worthiest(best: dict[int, Labelling]) -> Labelling:
    return min(best.values(), key=lambda labelling: labelling.cut - WORTH * labelling.motions)
