"""In the reader's process: an Alembic as frames of vertices, each step of reading in order."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from alembic3d import Abc
from jaxtyping import Float

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits
from caesura.formats.native.alembic.objects import Mesh, read_meshes
from caesura.formats.native.alembic.samples import Clock, find_clock
from caesura.formats.native.reader_answer import VerticesAnswer
from caesura.formats.notices import Notices

BLOCK_BYTES = 2**22


def read_archive(path: str, limits: Limits, notices: Notices) -> VerticesAnswer:
    """All meshes of the archive as one. Raises `BrokenContainer("malformed-alembic")` or `InvalidModel`."""
    with _errors():
        meshes = read_meshes(Abc.IArchive(path), limits)
        clock = find_clock((found for mesh in meshes for found in mesh.properties()), limits)
    first = np.cumsum([0, *(mesh.vertices for mesh in meshes)])
    triangles = np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, first[:-1], strict=True)])
    limits.check("max_triangle_frames", clock.frames * len(triangles), "Export a part of the take, or a lighter mesh")
    if abs(clock.begin * clock.rate) >= 0.5:
        notices.add(
            "take-start",
            f"The take begins at {clock.begin:.3f} s of the file's clock, frame {clock.begin * clock.rate:g}; frames "
            "are counted from there.",
        )
    return VerticesAnswer(triangles, int(first[-1]), clock.frames, clock.rate, _blocks(meshes, clock, int(first[-1])))


def _blocks(meshes: list[Mesh], clock: Clock, vertices: int) -> Iterator[Float[np.ndarray, "block V 3"]]:
    at_once = max(BLOCK_BYTES // (12 * vertices), 1)
    for start in range(0, clock.frames, at_once):
        frames = range(start, min(start + at_once, clock.frames))
        with _errors(), np.errstate(over="ignore", invalid="ignore"):
            yield np.stack(
                [
                    np.concatenate([mesh.world_positions(clock.second(frame)) for mesh in meshes]).astype(np.float32)
                    for frame in frames
                ]
            )


@contextmanager
def _errors() -> Iterator[None]:
    """Say of what the library cannot read that the file is broken."""
    try:
        yield
    except RuntimeError as wrong:
        said = " ".join(str(wrong).split())[:200]
        detail = f"The Alembic cannot be read ({said}). Export it again."
        raise BrokenContainer("malformed-alembic", detail) from None
