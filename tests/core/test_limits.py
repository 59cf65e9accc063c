"""Limits are checked before anything is allocated, and say how to go on."""

import json
import math

import pytest

from caesura.core.errors import LimitExceeded
from caesura.core.limits import Limits


@pytest.mark.parametrize("name", sorted(Limits.model_fields))
def test_every_limit_refuses_what_is_above_it_alone(name: str) -> None:
    """The refusal names the limit, the actual value and the setting."""
    limits = Limits()
    limit = getattr(limits, name)
    limits.check(name, limit)
    with pytest.raises(LimitExceeded) as refused:
        limits.check(name, limit * 2)
    assert refused.value.where == {"limit": limit, "actual": limit * 2, "setting": f"CAESURA_{name.upper()}"}
    assert f"CAESURA_{name.upper()}" in refused.value.detail


def test_a_number_too_large_for_an_integer_is_refused() -> None:
    """Nothing wraps round."""
    with pytest.raises(LimitExceeded, match="animation-too-long"):
        Limits().check("max_frames", 1e308)


def test_ones_own_machine_has_no_limits() -> None:
    """But for what no machine has."""
    for name in Limits.model_fields:
        Limits.none().check(name, 1e15)


@pytest.mark.parametrize("actual", [math.inf, math.nan, 10**400, 10**4299])
def test_what_json_cannot_say_is_told_as_a_number(actual: float) -> None:
    """A refusal is a problem document, however far over the limit: without infinity, NaN or hundreds of digits."""
    with pytest.raises(LimitExceeded) as refused:
        Limits().check("max_frames", actual)
    assert json.loads(json.dumps(refused.value.problem(), allow_nan=False))["actual"] > 1e200
