"""Duplicates: segments of a motion that are the same performance again, as in a take that was saved twice."""

import numpy as np

from caesura.core.together.motion_collection import MotionCollection

SAME = 0.004
"""Two performances by one person are farther apart than this, in distances that are `alike` within a motion; one that
was sampled otherwise or saved again is nearer."""
SAME_LENGTH = 0.05


def find_duplicates(collection: MotionCollection) -> dict[int, int]:
    """For each segment, by number, that an earlier one in another take is the same as: the first such one."""
    found: dict[int, int] = {}
    for motion in collection.motion_ids:
        members = collection.members(motion)
        apart = collection.distances(members, members)
        seconds = np.array([collection.segments[i].seconds for i in members])
        takes = np.array([collection.segments[i].take for i in members])
        alike = (apart <= SAME) & (np.abs(np.log(seconds[:, None] / seconds[None, :])) <= SAME_LENGTH)
        alike &= takes[:, None] != takes[None, :]
        for later, row in enumerate(alike):
            earlier = np.flatnonzero(row[:later])
            if len(earlier):
                found[int(members[later])] = found.get(int(members[earlier[0]]), int(members[earlier[0]]))
    return found


def best_segments(collection: MotionCollection) -> set[int]:
    """The segment of each motion that is most like all others of it."""
    return {motion.exemplar for motion in collection.motions}
