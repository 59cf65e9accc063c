"""Labels of parts of a take, in seconds or frames, which become a label for every frame beside another labelling."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from caesura.service.commands.frame_labels import MAX_FRAMES, Labelling

UNLABELLED = ""
"""The label of frames that nobody has labelled."""
BEYOND_SECONDS = 1.0
"""How far past the take's end a label may reach, as a hand that stops late makes it."""
END_FRAMES = 2
"""What ends so many frames before the take ends with it."""
MOST_INTERVALS = 100_000


@dataclass(frozen=True)
class TimedLabels:
    """Intervals [start, end) with a label each, in seconds on the file's own clock, or in frames."""

    unit: Literal["seconds", "frames"]
    intervals: tuple[tuple[float, float, str], ...]

    def on_frames_of(self, other: Labelling) -> Labelling:
        """The labelling of the same frames as another's; raises ValueError where they do not lie on them."""
        rate, begin = (other.frame_rate, other.start_seconds) if self.unit == "seconds" else (1.0, 0.0)
        most = other.frames + BEYOND_SECONDS * other.frame_rate
        last = max(end for _, end, _ in self.intervals)
        late = (last - begin) * rate
        if not late <= most:
            raise ValueError(f"it reaches to frame {late:.6g}, and the take has {other.frames}")
        placed = [
            (
                round(max((start - begin) * rate, 0)),
                _end(round(max((end - begin) * rate, 0)), other.frames, is_last=end == last),
                label,
            )
            for start, end, label in self.intervals
        ]
        segments = tuple(_tile((one for one in placed if one[0] < one[1]), other.frames))
        return Labelling(other.frame_rate, other.frames, segments, other.start_seconds)

    def at(self, frame_rate: float) -> Labelling:
        """The labelling at a frame rate, as long as the last label; raises ValueError where that is too long."""
        last = max(end for _, end, _ in self.intervals) * (frame_rate if self.unit == "seconds" else 1.0)
        if not 1 <= last <= MAX_FRAMES:
            raise ValueError(f"it reaches to frame {last:.6g}; 1 to {MAX_FRAMES} are possible")
        return self.on_frames_of(Labelling(frame_rate, round(last), ()))


def _end(frame: int, frames: int, *, is_last: bool) -> int:
    """The last frame's own time is often given for the end of a take, which is a frame later."""
    late = frame >= frames or (is_last and frames - frame <= END_FRAMES)
    return frames if late else frame


def _tile(intervals: Iterable[tuple[int, int, str]], frames: int) -> Iterable[tuple[int, int, str]]:
    """The same in order, with the gaps between them; raises ValueError where two overlap."""
    at = 0
    for start, end, label in sorted(intervals):
        if start < at:
            raise ValueError(f"two of its labels overlap at frame {start}")
        if at < start:
            yield at, start, UNLABELLED
        yield start, end, label
        at = end
    if at < frames:
        yield at, frames, UNLABELLED
