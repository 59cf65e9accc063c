"""The number of motions: of what the views found, the labelling of the least normalised cut, and how many it has."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from caesura.core.agreement import adjusted_rand_index
from caesura.core.methods.switching.frame_vote import vote_on_frames
from caesura.core.methods.switching.labellings import Labelling, Labellings
from caesura.core.methods.switching.views import View

DISAGREEMENT = 0.2
"""What it costs where the views agree on a labelling no more than chance would have it: the halves of a motion are not
the same in every view."""
FEWEST_VIEWS = 2
MOST_AGREE = 0.25
"""Three views of four agree so much or more: a view may miss a motion that is there."""
LESS = 2
"""Labellings of up to so many motions less are subdivided where a number is asked for."""
BEYOND = 4
"""So many more motions are asked of a view than are to be found, for some of them may be transitions."""
PATIENCE = 5
AROUND = 2
NEAR = 0.1
MOST_VOTES = 20
MOST = 200


@dataclass(frozen=True)
class MotionCountSearch:
    """One search for the best labelling: `found` are those that it looked at, whatever others did before."""

    labellings: Labellings
    found: dict[tuple[View, int] | bytes, Labelling] = field(default_factory=dict)

    @property
    def views(self) -> tuple[View, ...]:
        """The views that show something."""
        return self.labellings.views.names

    def ask(self, views: Iterable[View], motions: int) -> None:
        """Look at so many motions in each view."""
        for view in views:
            self.found[view, motions] = self.labellings.labelling(view, motions)

    def subdivide(self, counts: Iterable[int]) -> None:
        """Look at what the best labellings of these numbers of motions become with one motion more."""
        best = self.best()
        for count in counts:
            if count in best:
                for labelling in self.labellings.subdivisions(best[count]):
                    self.found.setdefault(labelling.labels.tobytes(), labelling)

    def best(self) -> dict[int, Labelling]:
        """For every number of motions that was found the labelling of the least normalised cut, the first of equals."""
        best: dict[int, Labelling] = {}
        for labelling in self.found.values():
            if labelling.motions not in best or labelling.rank < best[labelling.motions].rank - EQUAL:
                best[labelling.motions] = labelling
        return dict(sorted(best.items()))

    def of(self, motions: int) -> Labelling:
        """The best labelling of so many motions, or of as many as there can be."""
        for view in self.views:
            for more in range(BEYOND + 1):
                self.ask((view,), motions + more)
                if self.found[view, motions + more].motions >= motions:
                    break
        fewer = range(max(motions - LESS, 1), motions)
        for count in fewer:
            self.ask(self.views[:2], count)
            self.subdivide((count,))
        best = self.best()
        return self._agreed(max((count for count in best if count <= motions), default=min(best)))

    def choose(self) -> Labelling:
        """The labelling of the number of motions up to which each is worth what it adds to the normalised cut.

        One view tells about how many there are, and all of them which.
        """
        lead = self.views[:1]
        enough = 1 + PATIENCE
        for motions in range(1, MOST + 1):
            ahead = range(motions, max(enough, motions + self.labellings.threads - 1) + 1)
            self.labellings.prepare(product(lead, ahead))
            self.ask(lead, motions)
            enough = self._worthiest().motions + PATIENCE
            if motions >= enough:
                break
        tried = 0
        while (now := self._worthiest().motions) != tried:
            tried = now
            around = range(max(now - AROUND, 1), now + BEYOND + 1)
            self.labellings.prepare(product(self.views, around))
            for motions in around:
                self.ask(self.views, motions)
            self.subdivide((now,))
        return self._agreed(self._worthiest().motions)

    def _worthiest(self) -> Labelling:
        """From one motion on, the next number at which the motions that came in are worth what they add; the last."""
        best = self.best()
        agreement = {motions: self._agreement(labelling) for motions, labelling in best.items()}
        now = best[min(best)]
        while True:
            more = (other for other in best.values() if other.motions > now.motions)
            following = next((other for other in more if _is_worth_it(now, other, agreement)), None)
            if following is None:
                return now
            now = following

    def _agreement(self, labelling: Labelling) -> float | None:
        """How much the other views agree with a labelling: the adjusted Rand index that three of four of them reach.

        Each by that of its labellings of as many motions which is most like it. None where fewer than two have one; of
        a single motion, on which all agree; and of subdivisions, for which no view of the whole take is asked.
        """
        if labelling.motions == 1 or labelling.subdivided:
            return None
        views: dict[View, float] = {}
        for other in self.found.values():
            if (other.motions, other.subdivided) == (labelling.motions, 0) and other.view != labelling.view:
                agreement = adjusted_rand_index(labelling.labels, other.labels)
                views[other.view] = max(views.get(other.view, -1.0), agreement)
        return float(np.quantile(list(views.values()), MOST_AGREE)) if len(views) >= FEWEST_VIEWS else None

    def _agreed(self, motions: int) -> Labelling:
        """Of the labellings of so many motions hardly cut more than the best, that which agrees most with them.

        Where one view moves a cut or splits a motion, the others seldom do it in the same way; and they vote on every
        frame.
        """
        least = self.best()[motions]
        alike = (f for f in self.found.values() if (f.motions, f.subdivided) == (motions, least.subdivided))
        near = [found for found in alike if found.cut <= least.cut + NEAR]
        near = sorted(near, key=lambda found: found.cut)[:MOST_VOTES]
        agreement = [sum(adjusted_rand_index(one.labels, other.labels) for other in near) for one in near]
        most = near[int(np.argmax(np.array(agreement) >= max(agreement) - EQUAL))]
        return replace(most, labels=vote_on_frames(most.labels, (other.labels for other in near)))

    def scores(self) -> tuple[tuple[int, float], ...]:
        """What each number of motions tried leaves unexplained in the first view, as a share of what one does."""
        lead = (one for one in self.found.values() if one.view == self.views[0] and not one.subdivided)
        costs = [labelling.cost for labelling in lead]
        return tuple((i + 1, min(cost / (costs[0] or 1.0), 1.0)) for i, cost in enumerate(costs))


EQUAL = 1e-9


def _is_worth_it(now: Labelling, more: Labelling, agreement: Mapping[int, float | None]) -> bool:
    """Whether the motions that came in add no more than they may; where the views agree on them less, they add more."""
    before, after = agreement[now.motions], agreement[more.motions]
    doubt = DISAGREEMENT * (before - after) if before is not None and after is not None else 0.0
    return more.rank - now.rank + doubt < more.worth * (more.motions - now.motions)
