"""Parameters read what people write, and refuse what is out of range."""

import pytest

from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters


def test_parameters_come_back_from_their_own_dump() -> None:
    """What a record stores is read back as the same choices."""
    parameters = Parameters()
    assert Parameters.model_validate(parameters.model_dump()) == parameters


@pytest.mark.parametrize(
    ("given", "read"),
    [
        ({"fps": "source"}, "source"), ({"fps": "24"}, 24.0), ({"motions": "auto"}, "auto"), ({"motions": "3"}, 3),
        ({"normalize": "max"}, "max"), ({"normalize": "0.5"}, 0.5),
    ],
)  # fmt: skip
def test_a_word_or_a_number(given: dict[str, str], read: object) -> None:
    """Where a parameter takes a word or a number, the query string may say either."""
    assert getattr(Parameters.parse(given), next(iter(given))) == read


@pytest.mark.parametrize("given", [{"fps": "0"}, {"fps": "1001"}, {"motions": "0"}, {"normalize": "-1"}])
def test_a_number_out_of_range_is_refused(given: dict[str, str]) -> None:
    """A number that cannot be is refused, and the refusal names the parameter."""
    with pytest.raises(ParameterError) as refused:
        Parameters.parse(given)
    assert refused.value.where["parameter"] == next(iter(given))


def test_a_refusal_says_what_may_be_written_in_all_its_forms() -> None:
    """Neither the word nor the largest number alone: whoever asked for 5,000 motions was not looking for `auto`."""
    with pytest.raises(ParameterError, match=r"'auto'; or: .* 1000") as refused:
        Parameters.parse({"motions": 5000})
    assert len(refused.value.detail) < 300


@pytest.mark.parametrize("truth", [True, "true"])
@pytest.mark.parametrize("name", ["fps", "motions", "seed", "rest", "bins", "start"])
def test_a_truth_is_no_number(name: str, truth: object) -> None:
    """Python counts true as 1; one frame a second was never asked for."""
    with pytest.raises(ParameterError) as refused:
        Parameters.parse({name: truth})
    assert refused.value.where["parameter"] == name


@pytest.mark.parametrize("truth", [True, "true"])
def test_a_truth_is_one_where_it_is_asked_for(truth: object) -> None:
    """And a take may be called by that word."""
    assert Parameters.parse({"trim": truth}).trim is True
    assert Parameters.parse({"take": truth}).take == "true"
