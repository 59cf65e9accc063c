"""The segments of a take as a collection holds them, and their signatures."""

import numpy as np

from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import CollectedSegment
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace


def sign_take(space: PoseSpace, take: MeasuredTake) -> MotionSignatures:
    """The signatures of the segments of a take; raises `InvalidModel` (`not-comparable`) for another body."""
    track = space.track(take.name, take.poses)
    steps = np.minimum(-(-take.bounds // take.poses.stride), len(track))
    ranges = np.stack([steps[:-1], np.maximum(steps[1:], steps[:-1] + 1)], axis=1)
    ranges = np.minimum(ranges, [[len(track) - 1, len(track)]])
    return MotionSignatures.of(track, space.speeds(track, take.poses.rate), take.poses.rate, ranges)


def collect_segments(take: MeasuredTake) -> tuple[CollectedSegment, ...]:
    """The segments of a take, not yet of any common motion (−1)."""
    bounds = zip(take.bounds[:-1].tolist(), take.bounds[1:].tolist(), strict=True)
    return tuple(
        CollectedSegment(
            take=take.name,
            start=start,
            end=end,
            seconds=(end - start) / take.poses.frame_rate,
            motion=-1,
            own_motion=int(own),
            repetitions=int(count),
        )
        for (start, end), own, count in zip(bounds, take.motions, take.repetitions, strict=True)
    )
