"""Small motions beside a large one: they are one motion until the large one is out of sight."""

import numpy as np

from caesura.core.agreement import frame_accuracy
from caesura.core.methods.switching.labellings import Labelling, Labellings
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.subdivision import subdivide_motions
from caesura.core.methods.switching.views import VIEWS, Frames, Views
from tests.core.methods.test_switching import RATE, analysis_of, cut

LARGE, SMALL = 40.0, 0.8
STEP = round(RATE / 10)


def one_large_and_three_small(seed):
    """Swings of one component each about one pose, every motion twice, and their truth."""
    random = np.random.default_rng(seed)
    order = [0, 1, 2, 0, 3, 1, 3, 2]
    lengths = [int(RATE * random.uniform(3, 5)) for _ in order]
    parts = []
    for motion, length in zip(order, lengths, strict=True):
        angle = 2 * np.pi * np.arange(length) / RATE / (0.8 + 0.1 * motion)
        part = np.zeros((length, 8))
        part[:, 2 * motion] = (LARGE if motion == 0 else SMALL) * np.cos(angle)
        part[:, 2 * motion + 1] = (LARGE if motion == 0 else SMALL) * np.sin(angle)
        parts.append(part)
    return np.concatenate(parts) + random.normal(0, 0.005, (sum(lengths), 8)), np.repeat(order, lengths)


def test_small_motions_beside_a_large_one_are_found():
    """Told how many, and not told: in no view of the whole take do they differ by more than a fiftieth."""
    values, truth = one_large_and_three_small(seed=2)
    for motions in (4, "auto"):
        found = cut(analysis_of(values), motions).labels
        assert len(np.unique(found)) == 4
        assert frame_accuracy(found, truth) > 0.97


def test_no_half_of_a_motion_is_shorter_than_a_window():
    """At the ends of a segment the windows reach into the next: a glimpse of the other half is none."""
    values, truth = one_large_and_three_small(seed=2)
    merged = np.where(truth == 0, 0, 1)
    divided = list(subdivide_motions(merged, Views(Frames.of(analysis_of(values)))))
    assert divided
    for view, labels in divided:
        bounds = np.flatnonzero(np.diff(labels, prepend=-1, append=-1))
        assert np.diff(bounds).min() >= view.seconds * RATE - 2 * STEP


class CountedRefinement(Refinement):
    """Counts what it refines."""

    refined = 0

    def moved(self, labels):
        """As it does."""
        type(self).refined += 1
        return super().moved(labels)


def test_a_subdivision_that_is_far_too_dear_is_not_refined():
    """Refining takes time. Two halves of motions have a window somewhere: one is worth half as much, one too little."""
    values, truth = one_large_and_three_small(seed=2)
    merged = np.where(truth == 0, 0, 1)
    frames = Frames.of(analysis_of(values))
    labellings = Labellings(Views(frames), CountedRefinement.of(frames.values, frames.frame_rate))
    whole = Labelling(merged, (), VIEWS[0], labellings.graph.cut(merged), 2, 0.0, 10.0)
    assert len(list(subdivide_motions(merged, labellings.views))) == 2
    assert [found.motions for found in labellings.subdivisions(whole)] == [3]
    assert CountedRefinement.refined == 1
