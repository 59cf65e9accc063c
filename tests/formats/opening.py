"""Opening a file that a test has made."""

from collections.abc import Mapping
from typing import Any

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import read_animation


def opened(data: bytes | Mapping[str, bytes], limits: Limits | None = None, **parameters: Any) -> Animation:
    """The animation of one file, or of several by name."""
    parts = {"model": data} if isinstance(data, bytes) else data
    return read_animation(
        parts, Parameters.parse(parameters), limits or Limits(), lambda size: memoryview(bytearray(size))
    )


def codes(animation: Animation) -> set[str]:
    """What an animation was noted for."""
    return {notice.code for notice in animation.notices}
