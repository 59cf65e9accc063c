"""Which frames of a file a clip has."""

from dataclasses import dataclass

from caesura.formats.clips.clip_plan import Clip
from caesura.formats.takes.stored_range import stored_range


@dataclass(frozen=True)
class StoredFrames:
    """A file of `count` frames at `rate` a second, drawn from second `start` on at `drawn_rate`."""

    count: int
    rate: float
    start: float
    drawn_rate: float

    def of(self, clip: Clip) -> tuple[int, int]:
        """The frames [start, stop) of the file that a clip has, handles included, at least one.

        Without handles the clips of all segments have every frame of the take once, one after the other.
        """
        start, end = (self.start + frame / self.drawn_rate for frame in (clip.start_frame, clip.end_frame))
        return stored_range(self.count, self.rate, start, end, clip.extras.get("handles_seconds", 0.0))
