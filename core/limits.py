"""Limits of the size of a model. `Limits()` are the defaults of a service; `Limits.none()` has no limits."""

from pydantic import BaseModel, ConfigDict, Field

from caesura.core.errors import LimitExceeded

UNLIMITED = 2**62

LARGEST_SHOWN = 1e300
"""What a refusal says of anything larger: JSON has no infinity."""


class Limits(BaseModel):
    """Bounds checked before anything is allocated. Every field is a setting, `CAESURA_` + its name in capitals."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    max_json_bytes: int = Field(32 * 2**20, gt=0, description="bytes of a glTF's JSON")
    max_vertices: int = Field(500_000, gt=0, description="vertices, after instancing")
    max_triangles: int = Field(1_000_000, gt=0, description="triangles, after instancing")
    max_frames: int = Field(1_000_000, gt=0, description="frames of the take at the chosen rate")
    max_seconds: float = Field(4 * 3600.0, gt=0, description="seconds of the take")
    max_triangle_frames: int = Field(5_000_000_000, gt=0, description="frames x triangles, the work")
    max_node_frames: int = Field(1_000_000_000, gt=0, description="frames x nodes that are posed")
    max_decoded_bytes: int = Field(2**30, gt=0, description="bytes of static data (accessors, palettes), decoded")
    max_nodes: int = Field(50_000, gt=0, description="nodes of the scene")
    max_primitives: int = Field(10_000, gt=0, description="mesh primitives")
    max_inflated_bytes: int = Field(2 * 2**30, gt=0, description="bytes of an archive's members, inflated")
    max_takes: int = Field(1_000, gt=0, description="animations in one file")
    max_targets: int = Field(10_000, gt=0, description="morph targets of one primitive")
    max_target_vertices: int = Field(50_000_000, gt=0, description="morph targets x vertices")

    max_reader_bytes: int = Field(2 * 2**30, gt=0, description="bytes of memory to read an FBX, an Alembic or a USD")
    max_reader_seconds: int = Field(300, gt=0, description="processor seconds to read an FBX, an Alembic or a USD")

    @classmethod
    def none(cls) -> "Limits":
        """No limits: `caesura segment` on one's own machine."""
        return cls(**dict.fromkeys(cls.model_fields, UNLIMITED))

    def check(self, name: str, actual: float, advice: str = "", pointer: str | None = None) -> None:
        """Raise `LimitExceeded` where `actual` is over the limit called `name`; `pointer` is where in the file.

        Compared as given, before any conversion to int, so that 1e308 frames are refused and not wrapped.
        """
        limit = getattr(self, name)
        if actual <= limit:
            return
        actual = min(
            LARGEST_SHOWN, actual
        )  # in this order: also of what is infinite, no number, or an int of 400 digits
        what = type(self).model_fields[name].description
        setting = f"CAESURA_{name.upper()}"
        sentence = f"{actual:g} {what} are over the limit of {limit:g}. "
        advice = advice or "Send a smaller model"
        long = name in {"max_frames", "max_seconds"}
        raise LimitExceeded(
            "animation-too-long" if long else "limit-exceeded",
            f"{sentence}{advice}, or ask the operator of this service to raise {setting}.",
            limit=limit,
            actual=actual,
            setting=setting,
            pointer=pointer,
        )
