"""The bodies of calls on collections."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from caesura.core.revision import LONGEST_NAME

MOST_ADDED = 1000
"""Animations of one request."""

Name = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME)]
Colour = Annotated[str, Field(pattern=r"^#[0-9a-f]{6}$", description="#rrggbb")]
Animations = Annotated[tuple[Annotated[str, Field(max_length=100)], ...], Field(max_length=MOST_ADDED)]
Motions = Annotated[int, Field(ge=1, le=100)]


class _Body(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class NewCollection(_Body):
    """A collection to make, with the animations that are cut together at first."""

    name: Name
    animations: Animations = Field((), description="ids of animations; more can be added at any time")
    motions: Motions | Literal["auto"] = Field("auto", description="how many motions all takes have; `auto`: found")


class CollectionName(_Body):
    """What a collection is called from now on."""

    name: Name


class AddedTakes(_Body):
    """Animations to add."""

    animations: Animations = Field(min_length=1)


class MotionChange(_Body):
    """What a person calls a motion, and how it is shown; what is left out stays."""

    name: Name | None = None
    colour: Colour | None = None


class CorrectedSegment(_Body):
    """Frames [start, end) of a motion: one of the collection by its id, or by a name, which may be a new one."""

    start: int = Field(ge=0, lt=2**53)
    end: int = Field(ge=0, lt=2**53)
    motion: str | None = Field(None, max_length=100, description="the id of a motion of the collection")
    name: Name | None = Field(None, description="instead of `motion`: a name, new motions included")


class Correction(_Body):
    """The segments of a take as a person has set them: they tile it. What is as it was stays the program's."""

    segments: tuple[CorrectedSegment, ...] = Field(min_length=1, max_length=100_000)


class NewProposal(_Body):
    """A new cut of all takes together, to be looked at before it holds."""

    motions: Motions | Literal["auto"] = Field("auto", description="how many motions; `auto`: found")


class Decision(_Body):
    """What a person makes of a proposal."""

    status: Literal["accepted", "refused"]


class NewSearch(_Body):
    """An example: frames [start, end) of an animation, in the collection or not; without a range, all of it."""

    animation: str = Field(max_length=100)
    start: int = Field(0, ge=0, lt=2**53)
    end: int | None = Field(None, ge=1, lt=2**53, description="null: the last frame of the take")
    limit: int = Field(20, ge=1, le=200, description="how many ranges to find")
