"""Errors tell a person what to do and a program what happened, and travel as plain values."""

import json
import pickle

import pytest

from caesura.core.errors import (
    ERROR_KINDS,
    CaesuraError,
    InvalidModel,
    LimitExceeded,
    ParameterError,
    error_from_problem,
)


@pytest.mark.parametrize("kind", sorted(ERROR_KINDS))
def test_an_error_survives_being_told_as_a_problem(kind: str) -> None:
    """Through JSON and through pickle it is the same error of the same class."""
    error = ERROR_KINDS[kind]("some-code", "A sentence.", pointer="/accessors/3", frame=7, vertex=None)
    for again in (error_from_problem(json.loads(json.dumps(error.problem()))), pickle.loads(pickle.dumps(error))):
        assert type(again) is type(error)
        assert (again.code, again.detail, again.where) == (error.code, error.detail, error.where)


def test_an_error_reads_as_code_sentence_and_place() -> None:
    """What was not known is not told."""
    error = InvalidModel("non-finite-data", "No place in space.", frame=3, vertex=None)
    assert str(error) == "non-finite-data: No place in space. (frame 3)"


def test_the_file_and_the_parameters_are_different_faults() -> None:
    """Whoever catches input errors does not catch a mistyped parameter."""
    assert issubclass(LimitExceeded, CaesuraError)
    assert not issubclass(ParameterError, InvalidModel.__mro__[1])
