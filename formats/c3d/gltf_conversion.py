"""A C3D as a glTF with a node for every marker, each below one near it, so that the page draws what links them."""

import numpy as np
from jaxtyping import Float

from caesura.core.limits import Limits
from caesura.formats.c3d.markers import read_markers
from caesura.formats.c3d.point_data_layout import HEAD_BYTES, read_c3d_layout
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.gltf.writer import Channel, GlbWriter
from caesura.formats.notices import Notices

LOOKED_AT = 16
"""Frames in which markers are compared."""

MOST_LINKED = 1000
"""Markers that are linked; more stand each by itself."""


def convert_c3d_to_glb(data: memoryview, limits: Limits) -> GltfConversion:
    """As glTF: a node for every marker, in metres, y up, at the rate of its frames.

    Raises `BrokenContainer("malformed-c3d")`, `InvalidModel` or `LimitExceeded`.
    """
    layout = read_c3d_layout(bytes(data[:HEAD_BYTES]), len(data), limits)
    DecodeBudget(limits).check(layout.frames * layout.points * 3 * 4 * 8)
    notices = Notices()
    markers = read_markers(data, layout, notices)
    times = (np.arange(layout.frames) / layout.rate).astype(np.float32)
    writer = GlbWriter()
    nodes: dict[int, int] = {}
    channels = []
    for marker, parent in _links(markers.places[:: max(layout.frames // LOOKED_AT, 1)]):
        places = markers.places[:, marker] - (markers.places[:, parent] if parent >= 0 else 0)
        above = nodes[parent] if parent >= 0 else None
        nodes[marker] = writer.node(markers.names[marker], parent=above, translation=places[0])
        channels.append(Channel(nodes[marker], "translation", times, places.astype(np.float32)))
    writer.animation("motion", channels)
    return GltfConversion(writer.to_bytes(), notices.in_order())


def _links(places: Float[np.ndarray, "frames markers 3"]) -> list[tuple[int, int]]:
    """Every marker with the one above it, -1 for the first: the tree of the shortest links, by their longest in time.

    Markers of one limb stay as far apart as they are, and so are linked to each other (Prim's algorithm).
    """
    count = places.shape[1]
    if count > MOST_LINKED:
        return [(marker, -1) for marker in range(count)]
    nearest, above = np.full(count, np.inf), np.full(count, -1)
    waiting = np.ones(count, bool)
    found: list[tuple[int, int]] = []
    for _ in range(count):
        marker = int(np.argmin(np.where(waiting, nearest, np.inf))) if found else 0
        found.append((marker, int(above[marker])))
        waiting[marker] = False
        distance = np.linalg.norm(places - places[:, marker, None], axis=2).max(axis=0)
        closer = waiting & (distance < nearest)
        nearest[closer], above[closer] = distance[closer], marker
    return found
