"""How fast the energy curve and the whole method are, beside `np.copyto` of the same vertices and plain NumPy.

    python -m benchmarks.speed            # minutes; writes docs/performance.md and docs/pictures/performance.svg
    python -m benchmarks.speed --quick    # under 40 s; prints alone
    python -m benchmarks.speed --peers PYTHON    # beside KernelCPD, which that Python has (`benchmarks.peers`)
    python -m benchmarks.speed --huge     # and the command on an NPZ of 8 GB in a temporary folder

Every figure is a ratio of things measured in the same run, on two threads, best of several alternating turns, in
processor time per thread: other programs disturb it less than the clock.
Ends with status 1 where a ratio misses its bound.
"""

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.memory import beyond_input, of_the_command
from benchmarks.peers.peer_methods import NotInstalled, peers
from benchmarks.reports.growth import Series, drawn
from benchmarks.reports.report import write_section
from benchmarks.takes.skinned import Skinned
from benchmarks.takes.tube import Tube
from benchmarks.timing.curve import Curve
from benchmarks.timing.numpy_twin import twin
from benchmarks.timing.stopwatch import Cost, least
from caesura.core.energy.key_frames import find_local_maxima
from caesura.core.frames.blocks import split_into_blocks
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, segment

THREADS = 2
DOCS = Path(__file__).parent.parent / "docs"
TWIN_FRAMES = 320
WHOLE_BYTES = 2**29
"""Room for every frame of a large mesh: what is copied must be as much as is measured."""
Sizes = tuple[tuple[int, int], ...]
"""Frames and triangles."""

QUICK_GROWTH: dict[str, Sizes] = {
    "frames": ((1_000, 5_000), (8_000, 5_000)),
    "triangles": ((256, 20_000), (256, 80_000)),
}
GROWTH: dict[str, Sizes] = {
    "frames": tuple((frames, 5_000) for frames in (1_000, 4_000, 16_000, 64_000)),
    "triangles": tuple((256, triangles) for triangles in (5_000, 20_000, 100_000, 500_000)),
}
ENOUGH = 30_000_000
"""Triangle-frames that are measured at least, in as many turns as they take: the least of three short ones is luck."""


class Row(NamedTuple):
    """A measure, what it came to, and its bound: `most` or, where that is None, `least`; without both, only told."""

    measure: str
    value: float
    most: float | None = None
    least: float | None = None

    @property
    def holds(self) -> bool:
        """Whether the bound is kept."""
        return (self.most is None or self.value <= self.most) and (self.least is None or self.value >= self.least)


def copying(tube: Tube) -> Callable[[], object]:
    """`np.copyto` of the vertices on two threads."""
    target = np.zeros_like(tube.vertices)
    halves = split_into_blocks(len(target), (len(target) + 1) // THREADS)
    pool = ThreadPoolExecutor(THREADS)
    return lambda: list(pool.map(lambda half: np.copyto(target[slice(*half)], tube.vertices[slice(*half)]), halves))


def against_copy(turns: int, frames: int) -> Iterator[Row]:
    """The curve over the copy: codes in memory, streaming, shuffled, large; and the whole method over the curve."""
    tube = Tube.of(frames, 5_700)
    curve, told = Curve(tube.animation(frames)), Parameters.parse({"motions": 4})
    costs = least(
        {
            "copy": copying(tube),
            "curve": curve.energy,
            "streaming": Curve(curve.animation, memory_bytes=0).energy,
            "shuffled": Curve(tube.shuffled().animation(frames)).energy,
            "whole": lambda: segment(curve.animation, told, threads=THREADS),
        },
        turns,
    )
    size = f"{frames:,} × 5,700"
    copy, ours = costs["copy"].busy, costs["curve"].busy
    yield Row(f"energy curve over np.copyto, {size}", ours / copy, most=7)
    yield Row("the same by the clock of this machine", costs["curve"].clock / costs["copy"].clock)
    yield Row("the same, strain computed twice", costs["streaming"].busy / copy, most=10)
    yield Row("the same, vertices in shuffled order", costs["shuffled"].busy / copy)
    yield Row("whole default method, K given, over the curve alone", costs["whole"].busy / ours, most=6)


def against_copy_of_large(turns: int, triangles: int) -> Iterator[Row]:
    """A large mesh for a short time."""
    tube = Tube.of(300, triangles, WHOLE_BYTES)
    costs = least({"copy": copying(tube), "curve": Curve(tube.animation(300)).energy}, turns)
    ratio = costs["curve"].busy / costs["copy"].busy
    yield Row(f"energy curve over np.copyto, 300 × {triangles:,}, coherent order", ratio, most=8)


def against_twin(turns: int) -> Iterator[Row]:
    """Speed and digits beside NumPy in float64, on one thread each and on the same vertices."""
    tube = Tube.of(TWIN_FRAMES, 5_700)
    curve = Curve(tube.animation(TWIN_FRAMES), THREADS)
    costs = least(
        {"twin": lambda: twin(tube.vertices, tube.rest, tube.triangles, curve.window), "curve": curve.energy}, turns
    )
    exact, found = twin(tube.vertices, tube.rest, tube.triangles, curve.window), curve.energy()
    take = curve.surveyed()
    columns = take.block_pass.body.surface.triangles  # type: ignore[attr-defined]  # a tube is strained by its triangles
    strain = np.concatenate([t.T.copy() for _, t in curve.bare.surface.tiles(tube.vertices[:64])], axis=1)
    error = np.abs(strain - exact.strain[:64, columns]) / exact.scale
    apart = float(np.nanmax(np.abs(found - exact.energy)))
    same = np.array_equal(find_local_maxima(found), find_local_maxima(exact.energy))
    yield Row(
        "times faster than NumPy, two threads against one", costs["twin"].busy / costs["curve"].busy * 2, least=45
    )
    yield Row("strain, of the normaliser, 99.99 % of values within", float(np.percentile(error, 99.99)), most=1e-4)
    yield Row("strain, of the normaliser, all values within", float(error.max()), most=1e-3)
    yield Row("energy within", apart, most=1e-3)
    yield Row("share of takes with the same peaks", float(same), least=1)


def growth(lines: Mapping[str, Sizes], turns: int) -> tuple[list[Row], list[Series]]:
    """Time per triangle-frame as frames and triangles grow."""
    rows, series = [], []
    for name, sizes in lines.items():
        points = [(frames * triangles, seconds(frames, triangles, turns)) for frames, triangles in sizes]
        costs = [point[1] / point[0] * 1e9 for point in points]
        rows += [Row(f"ns a triangle-frame, {m:,} × {t:,}", cost) for (m, t), cost in zip(sizes, costs, strict=True)]
        ratio = max(costs) / min(costs)
        rows.append(Row(f"largest over smallest time a triangle-frame, as {name} grow", ratio, most=1.4))
        series.append(Series(f"as {name} grow", points))
    return rows, series


def seconds(frames: int, triangles: int, turns: int) -> float:
    """Processor time of a curve, per thread."""
    curve = Curve(Tube.of(frames, triangles).animation(frames))
    return least({"curve": curve.energy}, max(turns, ENOUGH // (frames * triangles)))["curve"].busy / THREADS


def skinned(turns: int) -> Iterator[Row]:
    """Reading, posing and skinning, over the curve alone."""
    take = Skinned.made()
    costs = least(take.ways(), turns)
    size = f"{take.sampled.frames:,} × {take.sampled.vertex_count:,} vertices"
    yield Row(f"skinned file to energy curve over the same from vertices, {size}", ratio(costs, "file", "vertices"), 2)


def against_ruptures(python: str, turns: int, frames: int) -> Iterator[Row]:
    """The cut alone beside KernelCPD, which is told how many cuts there are; both on the features of one take."""
    told = Parameters.parse({"motions": 4})
    analysis = analyse(Tube.of(frames, 2_000).animation(frames), told, threads=THREADS)
    values = np.concatenate([feature.values for feature in analysis.features], axis=1).astype(np.float64)
    cuts = int(np.count_nonzero(np.diff(cut(analysis, told).labels)))
    ours = least({"cut": lambda: cut(analysis, told)}, turns)["cut"].clock
    try:
        with peers(python) as others:
            theirs = min(others.cuts("kernel-cpd", values, cuts)[1] for _ in range(turns + 1))
    except NotInstalled as missing:
        yield Row(f"KernelCPD of ruptures over our cut: {missing}", float("nan"))
        return
    yield Row(f"KernelCPD of ruptures over our cut, {frames:,} frames, by the clock", theirs / ours)


def memory(huge: bool) -> Iterator[Row]:
    """What is held at most beyond the input, each in a process of its own."""
    yield Row("MB of anonymous memory beyond input, whole analysis, 64,000 × 5,000", beyond_input(64_000, 5_000), 256)
    if huge:
        yield Row("MB of anonymous memory, the command on a mapped NPZ of 8 GB", of_the_command(8), 1_000)


def ratio(costs: Mapping[str, Cost], one: str, other: str) -> float:
    """How many times the processor time of `other` is that of `one`."""
    return costs[one].busy / costs[other].busy


def breakdown(turns: int, frames: int) -> Iterator[Row]:
    """Each step alone, on one thread."""
    tube = Tube.of(frames, 5_700)
    for name, cost in least(Curve(tube.animation(frames)).stages(), turns).items():
        yield Row(f"step, ns a triangle-frame: {name}", cost.busy / (frames * len(tube.triangles)) * 1e9)


def table(rows: list[Row]) -> str:
    """The rows as Markdown."""
    lines = ["| measure | found | bound | |", "|---|---:|---:|---|"]
    for row in rows:
        bound = f"≤ {row.most:g}" if row.most is not None else f"≥ {row.least:g}" if row.least is not None else ""
        lines.append(f"| {row.measure} | {row.value:.3g} | {bound} | {'' if row.holds else 'missed'} |")
    return "\n".join(lines)


def main() -> None:
    """Measures, prints the table, writes the page unless quick, and says by the status whether every bound holds."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--quick", action="store_true", help="smaller and fewer; writes nothing")
    options.add_argument("--huge", action="store_true", help="also the command on a file of 8 GB")
    options.add_argument("--peers", default=sys.executable, metavar="PYTHON", help="the Python that has ruptures")
    given = options.parse_args()
    quick = given.quick
    turns, frames = (2, 1_280) if quick else (5, 4_580)
    rows = [*against_copy(5 * turns, frames), *against_copy_of_large(2 * turns, 50_000 if quick else 200_000)]
    rows += [*against_twin(1 if quick else 3), *breakdown(turns, 640)]
    grown, series = growth(QUICK_GROWTH if quick else GROWTH, 1 if quick else 3)
    rows += [*grown, *against_ruptures(given.peers, 1, 1_000 if quick else 4_580)]
    if not quick:
        rows += [*skinned(turns), *memory(given.huge)]
    if not quick:
        (DOCS / "pictures" / "performance.svg").write_text(drawn(series), encoding="utf-8")
        write_section(DOCS / "performance.md", "speed", table(rows))
    print(table(rows))
    sys.exit(0 if all(row.holds for row in rows) else 1)


if __name__ == "__main__":
    main()
