"""Compile and load everything once, before the first fork: a job then starts in milliseconds.

On one thread only: BLAS and OpenMP pools made before a fork hang the child (see `threadpoolctl` in core).
"""

from contextlib import suppress
from dataclasses import replace

import numpy as np
import trimesh  # noqa: F401  here once, and not in every job that reads shapes
from threadpoolctl import threadpool_limits

from caesura.core.analysis import Analysis
from caesura.core.animation import Animation, Take
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.core.registry.methods import METHODS
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.meshopt.view import MODES, decode_view
from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive
from caesura.formats.read import read_animation

FRAMES = 240
RATE = 30.0
SLOW = {"haca", "genetic"}
"""The loops of the first are those of aca, run thousands of times; the second has none that are compiled."""


_rehearsed_analyses: list[Analysis] = []
"""What `warm` has analysed, for `rehearse`."""


def warm_up() -> None:
    """Analyse and cut eight seconds of a bending sheet, by every method that has code of its own, and read glTF."""
    file = read_animation({"": example_gltf()}, Parameters(), Limits(), lambda size: memoryview(bytearray(size)))
    file.vertices(0, file.frames)
    for mode in MODES:
        with suppress(InvalidModel):  # what is in it does not matter: its loops are compiled to find that out
            decode_view(JsonObject({"mode": mode, "count": 3, "byteStride": 4}, ""), memoryview(bytes(40)))
    for method in METHODS.values():
        method.load()  # before the limit, which holds for what is loaded
    animation = example_sheet()
    parameters = Parameters(motions=2)
    with threadpool_limits(1):
        analysis = analyse(animation, parameters, threads=1)
        _rehearsed_analyses.append(analysis)
        for name in (name for name in METHODS if name not in SLOW):
            cut(analysis, parameters.model_copy(update={"method": name}))


def rehearse_cuts() -> None:
    """Cut what `warm` has analysed: after a fork the first touch of each page that was shared takes time."""
    for analysis in _rehearsed_analyses:
        cut(replace(analysis), Parameters(motions=2)).to_json()  # a copy, which knows no cut yet


def example_gltf() -> bytes:
    """A triangle that turns, moves and has a morph target, and one that has none."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    times = np.array([0, 1], np.float32)
    turns = np.array([[0, 0, 0, 1], [0, 0, 1, 0]], np.float32)
    writer = GlbWriter()
    triangle = np.array([[0, 1, 2]])
    writer.node("plain", mesh=writer.mesh("plain", [Primitive(corners, triangle)]))
    mesh = writer.mesh("triangle", [Primitive(corners, triangle, targets=[corners])], weights=[0.5])
    node = writer.node("triangle", mesh=mesh)
    writer.animation(
        "turn", [Channel(node, "rotation", times, turns), Channel(node, "translation", times, corners[:2])]
    )
    return writer.to_bytes()


def example_sheet(side: int = 6) -> Animation:
    """A square sheet that bends, stops, and stretches."""
    row, column = np.divmod(np.arange(side * side), side)
    flat = np.stack([column, row, np.zeros_like(row)], axis=1).astype(np.float32)
    corner = np.array([r * side + c for r in range(side - 1) for c in range(side - 1)])
    triangles = np.concatenate([corner[:, None] + [0, 1, side], corner[:, None] + [1, side + 1, side]])

    def vertices(start: int, stop: int) -> np.ndarray:
        time = np.arange(start, stop, dtype=np.float32)[:, None] / np.float32(RATE)
        first = time < FRAMES / RATE / 2
        posed = np.repeat(flat[None], stop - start, axis=0)
        posed[:, :, 2] = np.where(first, np.sin(4 * time) * flat[:, 0] ** 2 / side, 0)
        posed[:, :, 1] *= np.where(first, 1, 1.3 + 0.3 * np.sin(6 * time)).astype(np.float32)
        return posed

    take = Take(index=0, name="sheet", duration_seconds=(FRAMES - 1) / RATE, frames=FRAMES, frame_rate=RATE)
    return Animation(vertices, side * side, triangles.astype(np.int32), flat, FRAMES, RATE, take)
