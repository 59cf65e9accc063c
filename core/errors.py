"""Everything that can be wrong with what a person gave us.

Our exception hierarchy:

    CaesuraError
    ├── InputError              the file
    │   ├── UnsupportedMedia    is of a kind we do not read              (no glTF, GLB, NPZ, …)
    │   ├── BrokenContainer     cannot be opened                         (truncated, not JSON, bad zip)
    │   ├── InvalidModel        opens, but what it says cannot be used   (index out of range, NaN, no mesh)
    │   └── LimitExceeded       is larger than this installation allows  (limit, actual, setting)
    └── ParameterError          a parameter: unknown name, bad value, a take that is not there

Anything else that is raised is a bug of ours, and is never dressed up as one of these.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

ErrorDetail = str | int | float


class CaesuraError(Exception):
    """Something the person can mend.

    `code` is the stable, kebab-case name that programs match on; `detail` is one sentence or two for a
    person: what is wrong and what to do. Where it is wrong goes into `where`: `pointer` (a JSON pointer such
    as `/accessors/3`), `frame`, `vertex`, `parameter`; limits add `limit`, `actual` and `setting`.
    """

    kind: ClassVar[str] = "error"

    def __init__(self, code: str, detail: str, **where: ErrorDetail | None) -> None:
        super().__init__(detail)
        self.code = code
        self.detail = detail
        self.where: dict[str, ErrorDetail] = {k: v for k, v in where.items() if v is not None}

    def __str__(self) -> str:
        place = ", ".join(f"{name} {value}" for name, value in self.where.items())
        return f"{self.code}: {self.detail}" + (f" ({place})" if place else "")

    def __reduce__(self) -> tuple[Any, ...]:
        return (error_from_problem, (self.problem(),))

    def problem(self) -> dict[str, Any]:
        """This error as plain JSON values; `from_problem` makes the same error of it again."""
        return {"kind": self.kind, "code": self.code, "detail": self.detail, **self.where}

    @classmethod
    def of(cls, problem: Mapping[str, Any]) -> Self:
        """The error of this class that `problem` describes."""
        where = {k: v for k, v in problem.items() if k not in {"kind", "code", "detail"}}
        return cls(problem["code"], problem["detail"], **where)


class InputError(CaesuraError):
    """The file is at fault."""

    kind = "input"


class UnsupportedMedia(InputError):
    """The bytes are of a kind that is not read here."""

    kind = "unsupported-media"


class BrokenContainer(InputError):
    """The file is of a kind we read, but cannot be opened: truncated, not JSON, a bad zip."""

    kind = "broken-container"


class InvalidModel(InputError):
    """The file opens, but what it says cannot be used."""

    kind = "invalid-model"


class LimitExceeded(InputError):
    """The file is larger than this installation allows; `limit`, `actual` and `setting` say how to go on."""

    kind = "limit"


class ParameterError(CaesuraError):
    """A parameter is unknown, of the wrong type, out of range, or names what the file does not have."""

    kind = "parameter"


ERROR_KINDS: dict[str, type[CaesuraError]] = {
    error.kind: error
    for error in (
        CaesuraError, InputError, UnsupportedMedia, BrokenContainer, InvalidModel, LimitExceeded, ParameterError,
    )
}  # fmt: skip


def error_from_problem(problem: Mapping[str, Any]) -> CaesuraError:
    """The error that `CaesuraError.problem` described: how a worker's refusal reaches the service."""
    return ERROR_KINDS[problem["kind"]].of(problem)
