"""The same take cut into other numbers of motions: what a slider shows that goes over K."""

from collections.abc import Iterator

from core.analysis import Analysis
from core.parameters import Parameters
from core.pipeline import cut
from core.segmentation import Segmentation


def alternatives(analysis: Analysis, parameters: Parameters, found: Segmentation) -> Iterator[Segmentation]:
    """What `cut` answers for every number of motions that was scored when `found` chose its own; the nearest first.

    Exactly what it answers when that number is asked for. What the cuts have in common is computed once, so that
    each takes a fraction of the first (`Analysis.once`). Nothing where the number was given: nothing was scored.
    """
    scored = [score.motions for score in found.scores]
    for motions in sorted(scored, key=lambda motions: abs(motions - found.motions)):
        yield cut(analysis, parameters.model_copy(update={"motions": motions}))
