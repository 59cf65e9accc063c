"""Shapes are types, and the tests check them."""

import jaxtyping
import numpy as np
import pytest

from caesura.core.segmentation import number_by_appearance


def test_a_wrong_shape_is_refused() -> None:
    """Under pytest, calling core with an array of the wrong rank fails at the call."""
    with pytest.raises(jaxtyping.TypeCheckError):
        number_by_appearance(np.zeros((3, 2), np.int64))


def test_a_wrong_kind_of_number_is_refused() -> None:
    """Under pytest, floats where integers are named fail at the call."""
    with pytest.raises(jaxtyping.TypeCheckError):
        number_by_appearance(np.zeros(3))
