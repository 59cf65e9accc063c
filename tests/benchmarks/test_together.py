"""The measure of a search: ranked ranges against the repetitions that are there."""

from benchmarks.together.search import average_precision
from caesura.core.together.example_search import FoundRange

PLACES = [("a", 0, 30, "squat"), ("a", 30, 60, "squat"), ("a", 60, 90, "lunge"), ("b", 0, 40, "squat")]


def found(*ranges):
    """Ranges in order of rank."""
    return [FoundRange(take, start, end, float(rank)) for rank, (take, start, end) in enumerate(ranges)]


def test_what_is_found_early_counts_more():
    """Both squats first: 1; a lunge between them: (1 + 2/3) / 2; one of them only: 1/2."""
    others = PLACES[1:]
    assert average_precision(PLACES[0], others, found(("b", 5, 35), ("a", 32, 61))) == 1
    late = average_precision(PLACES[0], others, found(("b", 5, 35), ("a", 62, 88), ("a", 32, 61)))
    assert abs(late - (1 + 2 / 3) / 2) < 1e-12
    assert average_precision(PLACES[0], others, found(("b", 5, 35))) == 0.5


def test_the_example_is_left_out_and_nothing_is_found_twice():
    """A range over the one asked is no answer; a second one of a repetition is a wrong one."""
    others = PLACES[1:]
    assert average_precision(PLACES[0], others, found(("a", 0, 29), ("b", 5, 35), ("a", 32, 61))) == 1
    twice = average_precision(PLACES[0], others, found(("b", 5, 35), ("b", 10, 40), ("a", 32, 61)))
    assert abs(twice - (1 + 2 / 3) / 2) < 1e-12
