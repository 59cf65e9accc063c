"""Table 1 with stand-ins: triangles, frames, settings, key-frames, and the seconds of the whole method."""

from collections.abc import Iterator
from time import perf_counter

from benchmarks.paper.stand_ins import StandIn
from caesura.core.agreement import frame_accuracy, rand_index
from caesura.core.pipeline import segment
from caesura.core.segmentation import Segmentation

COLUMNS = (
    "animation", "triangles (paper)", "frames (paper)", "γ", "l/ω in γ", "key-frames", "frame accuracy",
    "Eq. 6 as accuracy", "seconds (paper)",
)  # fmt: skip
HEAD = (f"| {' | '.join(COLUMNS)} |", "|---" * len(COLUMNS) + "|")


def measured(takes: list[StandIn]) -> Iterator[tuple[StandIn, Segmentation, float]]:
    """Each take cut by the paper's method at the paper's settings, on one thread; the second of two runs is timed."""
    for take in takes:
        segment(take.animation, take.parameters())
        start = perf_counter()
        found = segment(take.animation, take.parameters())
        yield take, found, perf_counter() - start


def row(take: StandIn, found: Segmentation, seconds: float) -> str:
    """One line of the table."""
    triangles, frames, published = take.published
    animation = take.animation
    return (
        f"| stand-in for {take.name} | {len(animation.triangles):,} ({triangles:,}) | {animation.frames} ({frames})"
        f" | {animation.frame_rate:g} | {take.window:g}/{take.keyframe_window:g} | {len(found.key_frames)}"
        f" | {frame_accuracy(found.labels, take.truth):.3f} | {rand_index(found.labels, take.truth):.3f}"
        f" | {seconds:.2f} ({published:g}) |"
    )
