"""Takes made of a character's own clips, and the characters made up for them."""

import numpy as np

from benchmarks.takes.choreography import both_sides, choreography, mirrored
from benchmarks.takes.creatures import creature
from benchmarks.takes.joining import joined
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.samples.motion_curves import Motion


def test_a_creature_is_the_same_at_every_call():
    """By its seed; another seed is another body."""
    assert creature(2, 2) == creature(2, 2)
    assert creature(2, 2) != creature(4, 2)


def test_a_joined_take_has_the_motions_asked_for():
    """Each at least once, none twice in a row, and the truth tells the motion of every frame."""
    take, truth, repeats = joined("creature.glb", creature(6, 5), 4, seed=1)
    assert take.frames == len(truth)
    assert len(np.unique(truth)) == 4
    assert np.count_nonzero(np.diff(truth)) == 8
    assert len(repeats) == 9
    assert np.isfinite(take.vertices(0, take.frames)).all()


def test_a_file_of_few_clips_gives_what_it_has():
    """Asked for more, all are performed."""
    assert len(np.unique(joined("creature.glb", creature(6, 2), 9, seed=1).truth)) == 2


def test_rigid_parts_stay_rigid_in_the_cross_fades():
    """No triangle strains, between motions either."""
    take, _, _ = joined("creature.glb", creature(6, 3), 3, seed=2)
    strain, pairs = analyse(take, Parameters()).features
    assert strain.values.shape[1] == 0
    assert pairs.values.shape[1] > 0


def test_joining_is_the_same_however_it_is_drawn():
    """Frame by frame, or all at once."""
    take, _, _ = joined("creature.glb", creature(3, 3), 3, seed=3)
    whole = take.vertices(200, 206)
    np.testing.assert_array_equal(np.concatenate([take.vertices(i, i + 1) for i in range(200, 206)]), whole)


def test_a_mirrored_motion_is_the_other_side_s():
    """Left and right are exchanged, and what turns the trunk changes its sign; twice mirrored is as before."""
    curves = {
        "hand.R side": ((0.0, 5.0),),
        "hand twist": ((0.0, 1.0),),
        "chest twist": ((0.0, 7.0),),
        "turn": ((0, 2),),
    }
    other = mirrored(Motion("wave", 1.0, curves))
    assert other.curves == {
        "hand.L side": ((0.0, 5.0),),
        "hand twist": ((0.0, 1.0),),
        "chest twist": ((0.0, -7.0),),
        "turn": ((0, -2.0),),
    }
    assert mirrored(other).curves == curves


def test_thirty_motions_can_be_performed():
    """The repertoire with both sides is enough."""
    assert len(both_sides()) >= 7
    assert len({label for label, _, _ in choreography(5, motions=30).truth.segments}) == 30
