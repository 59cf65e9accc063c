"""Alembic archives of a square, written by the library that reads them."""

import tempfile
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

SQUARE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))
FACE = (0, 1, 2, 3)

Points = Sequence[Sequence[float]]


def moved(x: float = 0.0, y: float = 0.0) -> Points:
    """The square somewhere else."""
    return [(a + x, b + y, c) for a, b, c in SQUARE]


def archive(
    frames: Sequence[Points] = (SQUARE,),
    *,
    rate: float = 30.0,
    first: float = 0.0,
    kind: str = "PolyMesh",
    times: Sequence[float] | None = None,
    places: Sequence[Sequence[float]] = (),
    inherits: bool = True,
    faces: Sequence[Sequence[int]] = (),
    visible: int | None = None,
) -> bytes:
    """A mesh of one or several samples below a transform with `places`; faces may be others in every sample."""
    from alembic3d import Abc, AbcGeom
    from alembic3d.AbcCoreAbstract import AcyclicFlag, TimeSampling, TimeSamplingType, TimeVector

    imath = import_module("imath")  # which comes with alembic3d
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "square.abc"
        written = Abc.OArchive(str(path))
        sampling = TimeSampling(1 / rate, first)
        if times is not None:
            listed = TimeVector()
            listed.extend(times)
            sampling = TimeSampling(TimeSamplingType(AcyclicFlag.kAcyclic), listed)
        number = written.addTimeSampling(sampling)
        outer = AbcGeom.OXform(written.getTop(), "outer")
        outer.getSchema().set(_place((0, 0, 10)))
        inner = AbcGeom.OXform(outer, "inner", number)
        for place in places or [(0, 0, 0)]:
            sample = _place(place)
            sample.setInheritsXforms(inherits)
            inner.getSchema().set(sample)
        if visible is not None:
            AbcGeom.CreateVisibilityProperty(inner, number).setValue(visible)
        _write_mesh(AbcGeom, imath, inner, kind, number, frames, faces)
        del inner, outer, written  # which writes the file
        return path.read_bytes()


def _place(place: Sequence[float]) -> Any:
    from alembic3d import AbcGeom

    imath = import_module("imath")  # which comes with alembic3d
    sample = AbcGeom.XformSample()
    sample.setTranslation(imath.V3d(*place))
    return sample


def _write_mesh(
    geometry: Any, imath: Any, parent: Any, kind: str, number: int, frames: Sequence[Points],
    faces: Sequence[Sequence[int]],
) -> None:  # fmt: skip
    mesh = getattr(geometry, f"O{kind}")(parent, "square", number)
    for place, points in enumerate(frames):
        face = faces[place] if faces else FACE
        arrays = imath.V3fArray(len(points)), imath.IntArray(len(face)), imath.IntArray(1)
        for row, point in enumerate(points):
            arrays[0][row] = imath.V3f(*point)
        for row, corner in enumerate(face):
            arrays[1][row] = corner
        arrays[2][0] = len(face)
        mesh.getSchema().set(getattr(geometry, f"O{kind}SchemaSample")(*arrays))
