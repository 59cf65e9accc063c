"""The part of a take that is drawn: from `start` to `end`, in seconds of its own clock. Light: no NumPy."""

from caesura.core.errors import ParameterError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.takes.frame_rate import count_frames


def parse_time_range(parameters: Parameters, duration: float, first_key: float = 0.0) -> tuple[float, float]:
    """Start and end, within `duration` seconds; raises `ParameterError("outside-take")` where nothing is left."""
    start = max(parameters.start, first_key if parameters.trim else 0.0)
    end = duration if parameters.end == "last" else min(parameters.end, duration)
    if start > end:
        raise ParameterError(
            "outside-take",
            f"Nothing is left from {start:g} s to {end:g} s: the take is {duration:g} s long.",
            parameter="start" if start > duration else "end",
        )
    return start, end


def check_frame_count(
    limits: Limits, seconds: float, rate: float, triangles: int, nodes: int = 0, pointer: str = "/vertices"
) -> int:
    """Frames of so many seconds of what `pointer` names, compared with the limits while they are still a float."""

    def check(name: str, actual: float, advice: str) -> None:
        limits.check(name, actual, advice, pointer)

    check("max_seconds", seconds, "Send start and end for a part of it")
    frames = count_frames(seconds, rate)
    check("max_frames", frames, "Send a lower fps, or start and end for a part of it")
    check(
        "max_triangle_frames", frames * triangles, "Send a lower fps, start and end for a part of it, or a lighter mesh"
    )
    check("max_node_frames", frames * nodes, "Send a lower fps, start and end for a part of it, or fewer nodes")
    return int(frames)
