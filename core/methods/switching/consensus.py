"""Consensus: how much each descriptor counts, so that the answer hangs on it least.

On one take the strain of the surface tells the motions apart and the distances mislead, on another it is the other way
round, and neither a cost nor a margin says which: they are measured with the same weights. But where one weighting
splits a motion or joins two, the others seldom do it in the same way.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Int

from caesura.core.agreement import adjusted_rand_index

WEIGHTINGS = ((1.0, 1.0), (1.0, 0.5), (0.5, 1.0), (1.0, 0.0), (0.0, 1.0))
"""Of two descriptors: alike, one of them more, one of them alone. The first of equals counts."""
EQUAL = 1e-3


def find_consensus(labellings: Sequence[Int[np.ndarray, "steps"]]) -> int:
    """Which of the labellings agrees most with all of them: the highest mean adjusted Rand index, the first of equals.

    Only those of most motions are asked, for fewer than there are was not the question.
    """
    motions = [len(np.unique(labels)) for labels in labellings]
    asked = [i for i, count in enumerate(motions) if count == max(motions)]
    agreement = [np.mean([adjusted_rand_index(labellings[i], labellings[j]) for j in asked]) for i in asked]
    return asked[int(np.argmax(np.array(agreement) >= max(agreement) - EQUAL))]
