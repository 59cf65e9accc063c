"""Find the motions in a 3D animation: key-frames, labelled motions, the cuts between them, named clips.

    from caesura import segment

    found = segment(vertices, triangles, frame_rate=30, motions=5)  # (frames, V, 3) and (T, 3)
    found.labels, found.segments, found.energy

This package is the face. In a checkout `core` (the method), `formats`, `worker`, `service` and `samples` stand beside
it, and are linked here, so that they install under one name. The package itself loads nothing: everything comes with
the first use of a name below.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from caesura.api import open_animation, segment
    from caesura.client.async_client import AsyncClient
    from caesura.client.client import Client
    from caesura.core.animation import Animation
    from caesura.core.errors import CaesuraError
    from caesura.core.parameters import Parameters
    from caesura.core.segmentation import Segmentation
    from caesura.estimators import MotionFeatures, MotionSegmenter
    from caesura.joint_segmentation import JointSegmentation, segment_together

_HOMES = {
    "Animation": "caesura.core.animation",
    "AsyncClient": "caesura.client.async_client",
    "CaesuraError": "caesura.core.errors",
    "Client": "caesura.client.client",
    "JointSegmentation": "caesura.joint_segmentation",
    "MotionFeatures": "caesura.estimators",
    "MotionSegmenter": "caesura.estimators",
    "Parameters": "caesura.core.parameters",
    "Segmentation": "caesura.core.segmentation",
    "open_animation": "caesura.api",
    "segment": "caesura.api",
    "segment_together": "caesura.joint_segmentation",
}

__all__ = [  # noqa: RUF022  in the order in which they are met
    "segment", "open_animation", "Animation", "Parameters", "Segmentation", "segment_together", "JointSegmentation",
    "MotionSegmenter", "MotionFeatures", "Client", "AsyncClient", "CaesuraError",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    """A public name, from the module it is at home in (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'caesura' has no attribute {name!r}; it has {', '.join(__all__)}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
