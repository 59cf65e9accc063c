"""Find the motions in a 3D animation: arrays and buffers in, frozen values out.

    from core import segment

    found = segment(vertices, triangles, frame_rate=30, motions=5)  # (frames, V, 3) and (T, 3)
    found.labels, found.segments, found.energy

The package itself loads nothing: `core.errors`, `core.limits`, `core.parameters`, `core.document` and
`core.formats.header` are light (no NumPy) and serve the web process; everything else is numerics, and comes with
the first use of a name below.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from core.animation import Animation
    from core.estimators import MotionFeatures, MotionSegmenter
    from core.front_door import open_animation, segment
    from core.parameters import Parameters
    from core.segmentation import Segmentation

_HOMES = {
    "Animation": "core.animation",
    "MotionFeatures": "core.estimators",
    "MotionSegmenter": "core.estimators",
    "Parameters": "core.parameters",
    "Segmentation": "core.segmentation",
    "open_animation": "core.front_door",
    "segment": "core.front_door",
}

__all__ = [  # noqa: RUF022  in the order in which they are met
    "segment", "open_animation", "Animation", "Parameters", "Segmentation", "MotionSegmenter", "MotionFeatures",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    """A public name, from the module it is at home in (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'core' has no attribute {name!r}; it has {', '.join(__all__)}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
