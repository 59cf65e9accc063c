"""What a person may choose, with unit, range and source. One spelling in the API, the command and Python.

Heavy parameters decide what is computed from the vertices, once per choice; light ones decide how the stored
analysis is cut, in milliseconds. `ALGORITHM` changes whenever the same file and parameters may give another
result: it is part of every segmentation's id, so an old result never answers for a new method.
"""

import json
from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from caesura.core.errors import ParameterError
from caesura.core.registry.descriptors import DESCRIPTORS, PAIR_DISTANCES
from caesura.core.registry.methods import METHODS

ALGORITHM = "7"

Auto = Literal["auto"]
Positive = Field(gt=0, allow_inf_nan=False)

if TYPE_CHECKING:
    MethodName = str
    DescriptorName = str
else:
    MethodName = Literal[*METHODS]
    DescriptorName = Literal[*DESCRIPTORS]


_NAME = "|".join(DESCRIPTORS)
_DESCRIPTORS_PATTERN = f"^(auto|({_NAME})(,({_NAME}))*)$"


def _heavy(default: Any, description: str, **rules: Any) -> Any:
    return Field(default, description=description, json_schema_extra={"weight": "heavy"}, **rules)


def _light(default: Any, description: str, **rules: Any) -> Any:
    return Field(default, description=description, json_schema_extra={"weight": "light"}, **rules)


class Parameters(BaseModel):
    """Every knob of the method; the defaults are the paper's where it gives one, ours where it does not."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    take: str | int = _heavy("longest", "the take: its name, its index, `longest`, or `all`, one after the other")
    fps: Literal["source"] | Annotated[float, Field(gt=0, le=1000)] = _heavy(
        "source", "frames per second; `source` is the rate of the file's own keys"
    )
    start: float = _heavy(0.0, "seconds on the file's clock where the first frame is taken", ge=0)
    end: Literal["last"] | Annotated[float, Positive] = _heavy(
        "last", "seconds on the file's clock after which no frame is taken; `last` is the take's last frame"
    )
    trim: bool = _heavy(False, "start at the take's first key and not at 0")
    rest: Literal["bind", "mean"] | int = _heavy(
        "bind", "rest shape: `bind` (bind pose or base mesh, else frame 0), `mean`, or a frame's number"
    )
    descriptor: DescriptorName = _heavy(
        "strain",
        f"what is measured: {'; '.join(f'`{entry.name}`, {entry.description}' for entry in DESCRIPTORS.values())}",
    )
    descriptors: str = _heavy(
        "auto",
        "what every method sees, one or more of these names and commas; the energy curve is of the first that is of"
        " triangles. `auto`: `descriptor` and pair-distances",
        pattern=_DESCRIPTORS_PATTERN,
    )
    strain: Literal["log", "biot", "max"] = _heavy("log", "measure of strain: Hencky (`log`), Biot, or largest")
    curvature: Literal["gaussian", "mean"] = _heavy("gaussian", "which curvature the descriptor `curvature` is")
    scale_invariant: bool = _heavy(False, "take out a uniform scaling of the whole body before it is measured")
    normalize: Literal["p99.9", "max", "none"] | Annotated[float, Field(gt=0)] = _heavy(
        "p99.9", "strain that counts as 1: the 99.9th percentile, the largest, a number, or `none` (1)"
    )
    bins: int = _heavy(10, "levels of strain in the joint distribution (paper: B = 10)", ge=2, le=64)
    energy: Literal["modified", "joint", "distance"] = _heavy(
        "modified", "joint entropy of windows (Eq. 3) or of neighbours (Eq. 1), or plain distance of neighbours"
    )
    window_seconds: float = _heavy(1.3, "seconds, length l of a window of Eq. 3 (paper: 1.3 to 1.7)", gt=0, le=600)

    method: MethodName = _light("switching", "how the take is cut")
    expect: Literal["auto", "performance", "sheet"] = _light(
        "auto", "what `switching` takes the take for: a performance, or a sheet of clips laid end to end"
    )
    motions: Auto | Annotated[int, Field(ge=1, le=1000)] = _light("auto", "number of motion types K, or `auto`")
    keyframe_window_seconds: float = _light(
        2.0, "seconds, width ω in which a key-frame is the largest (paper: 2.0 to 2.3)", gt=0, le=600
    )
    threshold: float = _light(0.1, "share of the highest energy below which a peak is no key-frame", ge=0, le=1)
    details: bool = _light(
        False, "also return the variance curves of `joint-entropy` (Eq. 5) and the mean strains of its groups (Eq. 4)"
    )
    seed: int = _light(0, "seed of the random starts", ge=0, lt=2**32)

    @model_validator(mode="before")
    @classmethod
    def _name_descriptors_once(cls, given: Any) -> Any:
        """One spelling for one set, and `descriptor` the first of it; what is no set of names is left to be refused."""
        if not isinstance(given, dict):
            return given
        asked, first = given.get("descriptors", "auto"), given.get("descriptor", "strain")
        if isinstance(asked, (list, tuple)):
            asked = ",".join(map(str, asked))
        if asked == "auto" and first in DESCRIPTORS:
            asked = f"{first},{PAIR_DISTANCES}"
        names = dict.fromkeys(asked.split(",")) if isinstance(asked, str) else {}
        if not names or not DESCRIPTORS.keys() >= names.keys():
            return {**given, "descriptors": asked}
        ordered = sorted(names, key=lambda name: not DESCRIPTORS[name].per_triangle)  # stable
        return {**given, "descriptor": ordered[0], "descriptors": ",".join(ordered)}

    @property
    def descriptor_names(self) -> tuple[str, ...]:
        """What is measured: descriptors of triangles first, the one of the energy curve leading."""
        return tuple(self.descriptors.split(","))

    @classmethod
    def parse(cls, given: Mapping[str, Any]) -> "Parameters":
        """Parameters from query strings, command options or JSON; raises `ParameterError` naming the first fault."""
        unknown = [name for name in given if name not in cls.model_fields]
        if unknown:
            raise ParameterError(
                "unknown-parameter",
                f"There is no parameter {unknown[0]!r}. Known: {', '.join(cls.model_fields)}.",
                parameter=unknown[0],
            )
        try:
            parameters = cls.model_validate({name: _value(name, text) for name, text in given.items()})
        except ValidationError as refused:
            faults = refused.errors()
            name = str(faults[0]["loc"][0])
            reasons = dict.fromkeys(fault["msg"] for fault in faults if fault["loc"][0] == name)  # a word, or a number
            raise ParameterError(
                "invalid-parameter",
                f"{name} = {str(given[name])[:80]!r} is not possible: {'; or: '.join(reasons)}. "
                f"It is: {cls.model_fields[name].description}.",
                parameter=name,
            ) from None
        if METHODS[parameters.method].needs_motions:
            parameters.required_motions()
        return parameters

    def required_motions(self) -> int:
        """K; raises `ParameterError` where nobody said it."""
        if self.motions == "auto":
            raise ParameterError(
                "motions-needed",
                f"The method {self.method} must be told how many motions there are: send motions=K, a number."
                " The methods switching and joint-entropy find it themselves.",
                parameter="motions",
            )
        return self.motions

    def heavy(self) -> "dict[str, Any]":
        """The parameters an analysis depends on; light ones may change without touching a vertex."""
        return self.model_dump(include=parameter_names("heavy"))

    def canonical(self) -> str:
        """The same text for the same choices, however they were spelled: what ids are made of."""
        return json.dumps(self.model_dump(), sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def _value(name: str, given: Any) -> Any:
    """A query string says `3` where JSON says 3: numbers and booleans are read, all else is a name.

    Python counts true as 1, so where no boolean is asked for it is a word like any other, and nobody's frame rate.
    """
    value = given
    if isinstance(given, str):
        with suppress(ValueError):
            parsed = json.loads(given)
            value = parsed if isinstance(parsed, (int, float)) else given
    if isinstance(value, bool) and Parameters.model_fields[name].annotation is not bool:
        return given if isinstance(given, str) else json.dumps(given)
    return value


def parameter_names(weight: Literal["heavy", "light"]) -> set[str]:
    """The names of the parameters of one weight."""
    return {
        name
        for name, field in Parameters.model_fields.items()
        if isinstance(field.json_schema_extra, dict) and field.json_schema_extra["weight"] == weight
    }
