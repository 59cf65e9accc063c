"""Strain in 16 bits, and the strain that counts as 1."""

import numpy as np
import pytest

from caesura.core.block_pass.quantisation import CODES, Quantisation, find_normalising_strain


def histogram(coding, values):
    """How often each code occurs."""
    return np.bincount(coding.encode(values).ravel(), minlength=CODES)


def test_a_code_spells_its_value_to_a_part_in_4096():
    """Over the whole range, and codes rise with values."""
    values = np.geomspace(1.001 * 2.0**-12, 15.9, 5000, dtype=np.float32)[None]
    coding = Quantisation(1.0)
    codes = coding.encode(values)[0].astype(int)
    low = np.array([coding.decode(float(c)) for c in codes])
    assert (np.diff(codes) >= 0).all()
    assert (low <= values[0]).all()
    assert (values[0] <= low * (1 + 1 / 4096)).all()


def test_what_is_out_of_range_gets_the_first_and_the_last_code():
    """Zero is code 0; a thousand is the last."""
    assert Quantisation(1.0).encode(np.float32([[0, 1e-9, 1e3, 1e30]])).tolist() == [[0, 0, CODES - 1, CODES - 1]]


@pytest.mark.parametrize("size", [1e-6, 0.3, 40.0])
def test_the_percentile_is_numpys_to_a_ten_thousandth(size):
    """Whatever the unit of the data is."""
    values = (size * np.random.default_rng(0).gamma(2.0, size=(300, 400))).astype(np.float32)
    coding = Quantisation.for_largest(float(values[:, ::40].max()))
    found = find_normalising_strain("p99.9", coding, histogram(coding, values), float(values.max()), 1.0)
    assert found == pytest.approx(np.percentile(values, 99.9), rel=5e-5)


def test_the_percentile_of_equal_values_is_that_value():
    """All in one code: exact to the code's step."""
    coding = Quantisation.for_largest(0.37)
    values = np.full((5, 7), 0.37, np.float32)
    assert coding.percentile(histogram(coding, values)) == pytest.approx(0.37, rel=1 / 4096)


def test_the_other_rules_of_normalising():
    """The largest, a number, none; 1 for noise, and the largest where strain is too rare for a percentile."""
    coding, counts, largest = Quantisation(1.0), np.ones(CODES, int), 0.7
    assert find_normalising_strain("max", coding, counts, largest, 1.0) == pytest.approx(0.7)
    assert find_normalising_strain(0.25, coding, counts, largest, 1.0) == 0.25
    assert find_normalising_strain("none", coding, counts, largest, 1.0) == 1.0
    assert find_normalising_strain("p99.9", coding, counts, largest, 0.0) == 1.0
    assert find_normalising_strain("p99.9", coding, counts, largest, 0.0005) == pytest.approx(0.7)


@pytest.mark.parametrize("levels", [2, 10, 64])
def test_edges_of_bins_are_in_their_place_to_an_eight_thousandth(levels):
    """A value is above the i-th edge where it is above i / B of the scale, but for the half step about it."""
    coding, scale = Quantisation.for_largest(0.5), 0.31
    edges = coding.edges(scale, levels)
    for i, edge in enumerate(edges.tolist(), start=1):
        at = scale * i / levels
        around = np.float32([[at * (1 - 1 / 8000), at * (1 + 1 / 8000)]])
        assert (coding.encode(around) > edge).tolist() == [[False, True]]


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("shape", [(1, 1), (16, 8), (13, 64), (64, 5), (30, 27)])
def test_codes_kept_of_a_block_are_the_same_codes(shape, order):
    """Wherever its rows begin, however values lie and how many they are; nothing beside them is touched."""
    coding, at = Quantisation(1.0), 3
    values = np.random.default_rng(0).gamma(1.0, 2.0, shape).astype(np.float32, order=order)
    values[0, 0] = 0
    found = np.full((at + shape[0] + 2, shape[1]), 7, np.uint16)
    coding.write(values, found[at:-2])
    np.testing.assert_array_equal(found[at:-2], coding.encode(values))
    assert (found[:at] == 7).all()
    assert (found[-2:] == 7).all()


def test_codes_from_a_floor_on_are_counted_one_by_one_and_all_below_together():
    """The largest value, and how many are above the noise of their column, are told."""
    coding, noise = Quantisation(1.0), np.float32([0.1, 0.5, 30.0])
    values = np.random.default_rng(0).gamma(1.0, 2.0, (3, 50)).astype(np.float32)
    codes, found = coding.encode(values), np.zeros(CODES, np.int64)
    floor = int(np.percentile(codes, 80))
    largest, above = coding.count(values, noise, floor, found)
    expected = np.bincount(codes[codes >= floor], minlength=CODES)
    expected[0] = (codes < floor).sum()
    np.testing.assert_array_equal(found, expected)
    assert largest == values.max()
    assert above == (values > noise[:, None]).sum()


def test_the_percentile_of_two_values_is_measured_once_more_at_most():
    """One of them far below the other: the code that tells it lumps the other with all above, and that is right."""
    values, coding = np.float32([[1e-4, 0.5]]), Quantisation.for_largest(0.5)
    counts = histogram(coding, values)
    again = Quantisation.for_largest(coding.percentile(counts))
    assert not coding.resolves_edges(coding.percentile(counts), 10, counts)
    assert again.reaches_percentile(histogram(again, values))
