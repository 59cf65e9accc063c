"""Materials: their names and colours."""

from typing import Any

import numpy as np

from caesura.formats.gltf.writer import GlbWriter
from caesura.formats.native.fbx.held_objects import all_held, held


def write_materials(writer: GlbWriter, scene: Any) -> dict[int, int]:
    """Their places in the GLB, by the number that the library gives them."""
    return {
        material.typed_id: writer.material(material.name, _colour(material)) for material in all_held(scene.materials)
    }


def _colour(material: Any) -> tuple[float, float, float, float]:
    """Red, green, blue and opacity, in [0, 1]."""
    maps = held(material.pbr)
    base, factor, opacity = (held(getattr(maps, name)) for name in ("base_color", "base_factor", "opacity"))
    share = factor.value_vec4.x if factor.has_value else 1.0
    colour = np.array([*base.value_vec4[:3], 1.0]) * (share, share, share, 1.0)
    if opacity.has_value:
        colour[3] = opacity.value_vec4.x
    red, green, blue, alpha = np.clip(np.nan_to_num(colour, nan=1.0), 0.0, 1.0).tolist()
    return red, green, blue, alpha
