"""How clips are made of segments. Light: no NumPy, so that the web process can check and describe it."""

from collections.abc import Mapping
from typing import Any, Literal, Self
from urllib.parse import parse_qsl, urlencode

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from caesura.core.errors import ParameterError

LONGEST_LIST = 2000
"""Letters of a list of motions."""


class ClipOptions(BaseModel):
    """Every choice; the defaults give one file, clips from 0 seconds, all segments, the take itself taken out."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    keep_source: bool = Field(False, description="keep the take itself beside its clips")
    origin: Literal["start", "keep"] = Field(
        "start", description="where a clip's time begins: at 0 (`start`), or where it was in the take (`keep`)"
    )
    handles_seconds: float = Field(0.0, description="seconds of the take to add on either side", ge=0, le=60)
    min_seconds: float = Field(0.0, description="seconds below which a segment is no clip", ge=0, le=3600)
    split_repeats: bool = Field(False, description="one clip for each repetition, where a segment has several")
    loop: str = Field(
        "",
        max_length=LONGEST_LIST,
        description="motions whose clips loop, by name, with commas between: suffix `-loop`",
    )
    discard: str = Field("", max_length=LONGEST_LIST, description="motions to leave out, by name, with commas between")
    keep_discarded: bool = Field(False, description="clips of segments too that a revision discards")
    files: Literal["one", "separate"] = Field("one", description="one file with all clips, or a zip of one file each")
    animation_only: bool = Field(False, description="nodes and clips alone, without meshes and materials")

    @classmethod
    def parse(cls, query: str) -> Self:
        """The choices of a `canonical` text."""
        return cls.of(dict(parse_qsl(query)))

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Self:
        """The choices given; raises `ParameterError` naming the first that is not possible."""
        try:
            return cls.model_validate(given)
        except ValidationError as refused:
            first = refused.errors()[0]
            name = str(first["loc"][0])
            raise ParameterError("invalid-parameter", f"{name}: {first['msg']}.", parameter=name) from None

    def canonical(self) -> str:
        """The same text for the same choices, as a query string; empty for the defaults."""
        chosen = self.model_dump(exclude_defaults=True)
        return urlencode({name: str(chosen[name]).lower() if chosen[name] is True else chosen[name] for name in chosen})

    def looping(self) -> set[str]:
        """The names in `loop`."""
        return _listed(self.loop)

    def discarded(self) -> set[str]:
        """The names in `discard`."""
        return _listed(self.discard)


def _listed(names: str) -> set[str]:
    return {name.strip() for name in names.split(",") if name.strip()}
