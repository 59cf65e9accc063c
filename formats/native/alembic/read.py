"""An Alembic as an animation of its vertices."""

from collections.abc import Callable

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.native.read_as_vertices import read_as_vertices
from caesura.formats.native.reader_process import NativeReader

ALEMBIC = NativeReader(
    "Alembic", "alembic3d", "caesura.formats.native.alembic.read_in_child:read_archive", extra="alembic"
)


def read_alembic(
    data: memoryview, parameters: Parameters, limits: Limits, scratch: Callable[[int], memoryview]
) -> Animation:
    """The vertices of all its meshes at every frame, in the units and axes of the file.

    Raises `BrokenContainer` (`malformed-alembic`, `reader-crashed`), `InvalidModel` (`no-mesh`, `no-motion`,
    `varying-topology`), `LimitExceeded`, or `UnsupportedMedia("reader-missing")`.
    """
    return read_as_vertices(ALEMBIC, data, parameters, limits, scratch)
