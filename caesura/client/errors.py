"""What may go wrong between a program and a service."""

from collections.abc import Mapping
from typing import Any

from caesura.core.errors import CaesuraError


class Unreachable(CaesuraError):
    """There is no server to talk to, or it cannot do its work."""

    kind = "unreachable"


class ServiceProblem(CaesuraError):
    """The service's own problem, as it said it: `code`, `detail`, and all of it from `problem()`."""

    def __init__(self, problem: Mapping[str, Any]) -> None:
        super().__init__(str(problem["code"]), str(problem["detail"]))
        self._problem = dict(problem)

    def problem(self) -> dict[str, Any]:
        """The problem document, unchanged."""
        return self._problem

    def __reduce__(self) -> tuple[Any, ...]:
        return (ServiceProblem, (self._problem,))
