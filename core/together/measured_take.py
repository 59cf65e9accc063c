"""A measured take: its poses and its own segments, all that a collection needs of it; the vertices are not."""

import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from caesura.core.animation import Animation
from caesura.core.segmentation_document import Segment
from caesura.core.together.body_poses import BodyPoses, measure_poses


@dataclass(frozen=True)
class MeasuredTake:
    """`name`: how a collection calls it, unlike any other. `bounds` (segments + 1,): the first frame of each segment
    and the number of frames. `motions` (segments,): its own motions, and `repetitions` (segments,) how many times each
    is performed.
    """

    name: str
    poses: BodyPoses
    bounds: Int[np.ndarray, "bounds"]
    motions: Int[np.ndarray, "segments"]
    repetitions: Int[np.ndarray, "segments"]

    @classmethod
    def of(cls, name: str, poses: BodyPoses, segments: Sequence[Segment]) -> "MeasuredTake":
        """A take with the segments of its result, as a method or a person cut it."""
        return cls(
            name=name,
            poses=poses,
            bounds=np.array([segments[0].start, *(one.end for one in segments)], np.int64),
            motions=np.array([one.motion for one in segments], np.int64),
            repetitions=np.array([max(len(one.repeats), 1) for one in segments], np.int64),
        )

    @property
    def segments(self) -> int:
        """How many there are."""
        return len(self.motions)

    @property
    def seconds(self) -> float:
        """How long it is."""
        return self.poses.frames / self.poses.frame_rate

    def to_bytes(self) -> bytes:
        """As an NPZ of plain arrays: about 250 kB a minute of fifty joints."""
        out = io.BytesIO()
        np.savez(
            out,
            name=np.array(self.name),
            poses=np.frombuffer(self.poses.to_bytes(), np.uint8),
            bounds=self.bounds,
            motions=self.motions,
            repetitions=self.repetitions,
        )
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "MeasuredTake":
        """The take that `to_bytes` wrote."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            poses = BodyPoses.from_bytes(stored["poses"].tobytes())
            return cls(str(stored["name"]), poses, stored["bounds"], stored["motions"], stored["repetitions"])


def measure_take(name: str, animation: Animation, segments: Sequence[Segment]) -> MeasuredTake:
    """A take as it is compared with others: its poses, and the segments of its result.

    Raises `InvalidModel`: `not-comparable` for a body of fewer than three points, `non-finite-data` naming the frame.
    """
    return MeasuredTake.of(name, measure_poses(animation), segments)
