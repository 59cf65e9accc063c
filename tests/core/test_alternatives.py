"""What a slider shows that goes over K."""

from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, cut_into_other_motion_counts
from tests.animations import performing_bar


def test_an_alternative_is_what_is_cut_when_that_number_is_asked_for():
    """Whatever the cuts share, each is the same document as one that is made alone; the nearest number comes first."""
    bar = performing_bar((0, 1, 2, 0), seconds=3.0, rings=8).animation
    found = cut(analyse(bar), Parameters())
    scored = [score.motions for score in found.scores]
    made = list(cut_into_other_motion_counts(analyse(bar), Parameters(), scored, found.motions))
    asked = [one.parameters["motions"] for one in made]
    assert sorted(asked) == scored
    assert asked[0] == found.motions
    alone = [cut(analyse(bar), Parameters(motions=motions)) for motions in asked]
    assert [one.to_json() for one in made] == [one.to_json() for one in alone]
