"""A point cache and its OBJ, read: the places of the one, the faces of the other."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.bundle.polygon_mesh import read_obj
from caesura.formats.bundle.read import drop_repeated_triangles
from caesura.formats.notices import Notices
from caesura.formats.npz.read import check_triangles, vertex_sequence_from_arrays
from caesura.formats.point_cache.layout import (
    MDD_HEAD,
    PC2_HEAD,
    PointCacheLayout,
    is_even,
    mean_rate,
    rate_of_step,
    read_mdd_layout,
    read_mdd_seconds,
    read_pc2_layout,
)

Scratch = Callable[[int], memoryview]


def read_pc2(
    data: memoryview, mesh: memoryview, parameters: Parameters, limits: Limits, _scratch: Scratch
) -> Animation:
    """The animation of a PC2 and the OBJ `mesh`. A PC2 counts frames and no seconds: 30 a second are assumed.

    Raises `malformed-pc2`, `LimitExceeded`, or `InvalidModel`: `malformed-shape`, `unmatched-points`, `no-mesh`,
    `no-motion`, `index-out-of-range`, and
    `non-finite-data` where frames are drawn.
    """
    layout = read_pc2_layout(bytes(data[: PC2_HEAD.size]), len(data), limits)
    notices = Notices()
    rate = None
    if layout.frames_per_sample != 1:
        rate = rate_of_step(layout)
        notices.add(
            "frame-rate-assumed",
            f"The PC2 has a sample every {layout.frames_per_sample:g} frames and no frame rate; {rate:g} samples a "
            "second are assumed.",
        )
    return _read_points(layout, data, mesh, rate, parameters, limits, notices)


def read_mdd(
    data: memoryview, mesh: memoryview, parameters: Parameters, limits: Limits, _scratch: Scratch
) -> Animation:
    """The animation of an MDD and the OBJ `mesh`, at the mean rate of its samples.

    Raises as `read_pc2` does, `malformed-mdd` for `malformed-pc2`.
    """
    layout = read_mdd_layout(bytes(data[: MDD_HEAD.size]), len(data), limits)
    seconds = read_mdd_seconds(data, layout)
    rate = mean_rate(seconds[0], seconds[-1], layout.samples)
    notices = Notices()
    if rate is not None and not is_even(seconds, rate):
        notices.add("uneven-samples", f"The samples of the MDD are not evenly apart; {rate:g} a second are assumed.")
    return _read_points(layout, data, mesh, rate, parameters, limits, notices)


def _read_points(
    layout: PointCacheLayout,
    data: memoryview,
    mesh: memoryview,
    rate: float | None,
    parameters: Parameters,
    limits: Limits,
    notices: Notices,
) -> Animation:
    shape, faces = _read_mesh(mesh, limits)
    if len(shape) != layout.points:
        raise InvalidModel(
            "unmatched-points",
            f"The cache has {layout.points:,} points and the OBJ {len(shape):,} vertices. Send the mesh that the cache "
            "was made of, exported in the same order and without triangulating or splitting it.",
        )
    if layout.samples < 2:
        raise InvalidModel("no-motion", "The cache has one sample; a motion needs two.")
    stored = np.ndarray((layout.samples, layout.points, 3), f"{layout.order}f4", data, layout.start)
    triangles = drop_repeated_triangles(check_triangles(faces, layout.points, notices), notices)
    return vertex_sequence_from_arrays(stored, triangles, None, rate, parameters, limits, notices)


def _read_mesh(mesh: memoryview, limits: Limits) -> tuple[Float[np.ndarray, "V 3"], np.ndarray]:
    try:
        vertices, triangles = read_obj(bytes(mesh), limits)
    except InvalidModel as wrong:
        raise InvalidModel(wrong.code, f"The OBJ beside the cache {wrong.detail}. Export it again.") from None
    if not len(triangles):
        raise InvalidModel("no-mesh", "The OBJ beside the cache has no faces. Export the surface that it moves.")
    return vertices, triangles
