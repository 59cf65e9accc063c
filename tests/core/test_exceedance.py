"""A bit for every triangle, frame and edge between bins; and how many bits are set at two times at once."""

import numpy as np
import pytest

from core.exceedance.kernels import RUN, WORD, count_pairs, exceed


@pytest.mark.parametrize("columns", [1, 63, 64, 65, 1000])
def test_a_bit_says_whether_a_code_is_above_an_edge(columns):
    """Least code and largest edge included; room beside the columns exceeds nothing."""
    draw = np.random.default_rng(columns)
    codes = np.zeros((5, -(-columns // WORD) * WORD), np.uint16)
    codes[:, :columns] = draw.integers(0, 2**16, (5, columns))
    edges = np.array([0, 1, 30_000, 30_000, 65_534, 65_535], np.uint16)
    words = np.empty((5, len(edges), codes.shape[1] // WORD), np.uint64)
    exceed(codes, edges, words)
    bits = np.unpackbits(words.astype("<u8").view(np.uint8), axis=2, bitorder="little")
    np.testing.assert_array_equal(bits, codes[:, None] > edges[:, None])


@pytest.mark.parametrize("columns", [1, 100, (RUN + 1) * WORD])
def test_counts_are_of_the_bins_at_both_times(columns):
    """As many bits set as edges are below: that is a bin; rows longer than are counted in one run, too."""
    draw, levels = np.random.default_rng(0), 5
    bins = draw.integers(0, levels, (2, 3, columns))
    above = bins[:, :, None] > np.arange(levels - 1)[:, None]
    padded = np.pad(above, [(0, 0)] * 3 + [(0, -columns % WORD)])
    words = np.ascontiguousarray(np.packbits(padded, axis=3, bitorder="little")).view("<u8").astype(np.uint64)
    counts = np.empty((3, levels**2), np.int32)
    count_pairs(words[0], words[1], columns, counts)
    expected = [np.bincount(one * levels + other, minlength=levels**2) for one, other in zip(*bins, strict=True)]
    np.testing.assert_array_equal(counts, expected)
