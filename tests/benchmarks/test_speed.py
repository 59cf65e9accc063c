"""What speed is measured with: the twin, the tube and the plot. No test is timed."""

from xml.etree import ElementTree

import numpy as np

from benchmarks.reports.growth import Series, drawn
from benchmarks.speed import Row, table
from benchmarks.takes.tube import Tube
from benchmarks.timing.curve import Curve
from benchmarks.timing.numpy_twin import twin
from caesura.core.energy.key_frames import find_local_maxima

FRAMES = 150


def test_the_twin_in_plain_numpy_has_the_same_curve() -> None:
    """Energy within a thousandth, the same peaks, with codes in memory and computed twice."""
    tube = Tube.of(FRAMES, 1_200)
    curve = Curve(tube.animation(FRAMES))
    expected = twin(tube.vertices, tube.rest, tube.triangles, curve.window).energy
    found = curve.energy()
    np.testing.assert_allclose(found, expected, atol=1e-3)
    np.testing.assert_array_equal(find_local_maxima(found), find_local_maxima(expected))
    np.testing.assert_array_equal(Curve(curve.animation, memory_bytes=0).energy(), found)


def test_a_tube_in_shuffled_order_has_the_same_curve() -> None:
    """Where vertices lie in memory is no part of the body."""
    tube = Tube.of(FRAMES, 1_200)
    found = Curve(tube.shuffled().animation(FRAMES)).energy()
    np.testing.assert_allclose(found, Curve(tube.animation(FRAMES)).energy(), atol=1e-12)


def test_a_long_take_repeats_the_frames_it_has() -> None:
    """Also where a block reaches over the end of the distinct ones."""
    tube = Tube.of(70, 400)
    np.testing.assert_array_equal(tube.animation(200).vertices(64, 76), tube.vertices[[*range(64, 70), *range(6)]])


def test_the_plot_has_a_line_and_a_dot_for_every_measurement() -> None:
    """And is well-formed."""
    plot = ElementTree.fromstring(drawn([Series("one", [(1e6, 0.01), (1e7, 0.1)]), Series("two", [(1e6, 0.02)])]))
    kinds = [element.tag.rpartition("}")[2] for element in plot.iter()]
    assert kinds.count("polyline") == 2
    assert kinds.count("circle") == 3


def test_a_bound_that_is_missed_says_so() -> None:
    """On either side."""
    rows = [Row("a", 8, most=7), Row("b", 40, least=45), Row("c", 1)]
    assert [row.holds for row in rows] == [False, False, True]
    assert table(rows).count("missed") == 2
