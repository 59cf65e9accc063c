"""The options of clips. Light: no NumPy, so that the web process can check and describe them."""

from collections.abc import Mapping
from typing import Any, Literal, Self
from urllib.parse import parse_qsl, urlencode

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from caesura.core.errors import ParameterError
from caesura.formats.clips.clip_names import FIELDS, PATTERN, check_pattern

LONGEST_LIST = 2000
"""Letters of a list of motions, or of segments."""
LONGEST_PATTERN = 100
AUTO = "auto"


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
        description=(
            "motions whose clips loop, by name, with commas between: suffix `-loop`; `auto`: of each motion that"
            " repeats the best loop, and of segments that a revision marks"
        ),
    )
    loop_blend_seconds: float = Field(
        0.0, description="seconds at the end of a clip that loops over which it is bent to its beginning", ge=0, le=2
    )
    root: Literal["keep", "in_place"] = Field(
        "keep", description="the travel of clips that loop: kept, or taken out (`in_place`)"
    )
    only: str = Field(
        "",
        max_length=LONGEST_LIST,
        pattern=r"^(\d{1,6}(-\d{1,6})?(,\d{1,6}(-\d{1,6})?)*)?$",
        description="the segments to make clips of, by number from 1, such as `1,4-6`; all where it is empty",
    )
    names: str = Field(
        PATTERN,
        max_length=LONGEST_PATTERN,
        description=f"how clips are called, with {', '.join(f'`{{{name}}}`' for name in FIELDS)} in it",
    )
    discard: str = Field("", max_length=LONGEST_LIST, description="motions to leave out, by name, with commas between")
    keep_discarded: bool = Field(False, description="clips of segments too that a revision discards")
    form: Literal["source", "glb"] = Field(
        "source", description="clips of the kind of file that was sent, where Caesura writes it, or a GLB (`glb`)"
    )
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
            options = cls.model_validate(given)
        except ValidationError as refused:
            first = refused.errors()[0]
            name = str(first["loc"][0])
            raise ParameterError("invalid-parameter", f"{name}: {first['msg']}.", parameter=name) from None
        check_pattern(options.names)
        return options

    def canonical(self) -> str:
        """The same text for the same choices, as a query string; empty for the defaults."""
        chosen = self.model_dump(exclude_defaults=True)
        return urlencode({name: str(chosen[name]).lower() if chosen[name] is True else chosen[name] for name in chosen})

    @property
    def finds_loops(self) -> bool:
        """Whether segments are cut to their best loops."""
        return self.loop == AUTO

    def loop_names(self) -> set[str]:
        """The names in `loop`."""
        return set() if self.finds_loops else _split_names(self.loop)

    def chooses(self, number: int) -> bool:
        """Whether a segment of this number, from 1, is to be a clip."""
        return not self.only or any(first <= number <= last for first, last in self._chosen())

    def _chosen(self) -> list[tuple[int, int]]:
        bounds = [part.partition("-") for part in self.only.split(",")]
        return [(int(first), int(last or first)) for first, _, last in bounds]

    def discard_names(self) -> set[str]:
        """The names in `discard`."""
        return _split_names(self.discard)


def _split_names(names: str) -> set[str]:
    return {name.strip() for name in names.split(",") if name.strip()}
