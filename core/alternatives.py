"""The same take cut into other numbers of motions: what a slider shows that goes over K."""

from collections.abc import Iterable, Iterator

from caesura.core.analysis import Analysis
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut
from caesura.core.segmentation import Segmentation


def cut_into_other_motion_counts(
    analysis: Analysis, parameters: Parameters, scored: Iterable[int], chosen: int
) -> Iterator[Segmentation]:
    """What `cut` answers for every number of motions that was scored when it chose one; the nearest to that first.

    Exactly what it answers when told that number. What the cuts have in common is computed once, so that each takes
    a fraction of the first (`Analysis.once`).
    """
    for motions in sorted(scored, key=lambda motions: (abs(motions - chosen), motions)):
        yield cut(analysis, parameters.model_copy(update={"motions": motions}))
