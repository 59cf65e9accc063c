"""The frames of a glTF: one take, a part of it, or all takes one after the other."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from caesura.core.animation import Take, Vertices
from caesura.core.errors import ParameterError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.gltf.animation.sampling import KeyTracks
from caesura.formats.gltf.animation.take_choice import ChosenTake
from caesura.formats.gltf.posing.posed_vertices import PosedVertices
from caesura.formats.notices import Notices
from caesura.formats.takes.frame_rate import count_frames
from caesura.formats.takes.joined_takes import JoinedTakes
from caesura.formats.takes.time_range import check_frame_count, parse_time_range

SHOWN = 20

PoseFunction = Callable[[KeyTracks, float], PosedVertices]
"""Makes the vertices of a take, its frame 0 at some second."""


class SceneSize(NamedTuple):
    """What is drawn in every frame, and what is posed for it."""

    triangles: int
    nodes: int


@dataclass(frozen=True)
class SampledTake:
    """Frames to draw, their number, the second of the first one, and the take that they are of."""

    vertices: Vertices
    frames: int
    start_seconds: float
    take: Take


def sample_one_take(
    chosen: ChosenTake,
    tracks: KeyTracks,
    pose: PoseFunction,
    rate: float,
    size: SceneSize,
    parameters: Parameters,
    limits: Limits,
) -> SampledTake:
    """A take, or the part of it that the parameters name."""
    start, end = parse_time_range(parameters, tracks.duration, tracks.first)
    frames = check_frame_count(limits, end - start, rate, size.triangles, size.nodes, f"/animations/{chosen.index}")
    take = Take(chosen.index, chosen.name, tracks.duration, frames, rate)
    return SampledTake(pose(tracks, start), frames, start, take)


def join_all_takes(
    chosen: list[ChosenTake],
    tracks: list[KeyTracks],
    pose: PoseFunction,
    rate: float,
    size: SceneSize,
    parameters: Parameters,
    limits: Limits,
    notices: Notices,
) -> SampledTake:
    """All takes in the order of the file, on the clock of a film of them, of which the parameters may name a part.

    Every take begins with a frame of its own; `trim` begins each at its first key. The film has index -1.
    """
    starts = [take.first if parameters.trim else 0.0 for take in tracks]
    lengths = [count_frames(take.duration - start, rate) for take, start in zip(tracks, starts, strict=True)]
    from_frame = math.ceil(min(parameters.start * rate, sum(lengths)) - 1e-6)
    until = sum(lengths) if parameters.end == "last" else min(count_frames(parameters.end, rate), sum(lengths))
    if from_frame >= until:
        detail = f"Nothing is left from {parameters.start:g} s on: all takes are {sum(lengths) / rate:g} s long."
        raise ParameterError("outside-take", detail, parameter="start")
    check_frame_count(limits, (until - 1) / rate, rate, size.triangles, size.nodes, "/animations")
    frames = int(until) - from_frame
    first = [0]
    for length in lengths:
        first.append(first[-1] + int(min(length, until)))
    _note_joined_takes(notices, chosen, first)
    vertices = tuple(pose(take, start) for take, start in zip(tracks, starts, strict=True))
    take = Take(-1, "all", (sum(lengths) - 1) / rate, frames, rate)
    return SampledTake(JoinedTakes(vertices, tuple(first), from_frame), frames, from_frame / rate, take)


def _note_joined_takes(notices: Notices, chosen: list[ChosenTake], first: list[int]) -> None:
    begins = ", ".join(f"{take.name[:40]!r} at {frame}" for take, frame in zip(chosen[:SHOWN], first, strict=False))
    more = f", and {len(chosen) - SHOWN} more" if len(chosen) > SHOWN else ""
    notices.add(
        "takes-joined", f"All {len(chosen)} takes follow each other. They begin at these frames: {begins}{more}."
    )
