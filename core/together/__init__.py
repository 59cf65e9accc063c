"""Several takes together: one set of motions over all of them, further takes labelled by it, and search by example.

body_poses         where the same points of a body are, in every take
compared_body      the points that takes have in common, or what differs
mirror_symmetry    left and right of a body
pose_space         poses of all takes as the same few numbers
pose_space_file    a pose space as plain arrays
motion_signature   what a stretch of motion is like, however fast and from which phase on
measured_take      a take as it is compared: its poses and its own segments
motion_collection  the motions of several takes, frozen
collection_file    a collection as bytes
take_segments      the segments of a take, and their signatures
linkage            segments of all takes grouped into motions
segment_together   from takes to a collection
take_labelling     a further take labelled by the motions that are known
corrections        what a person says of one segment, and what it proposes for others
duplicates         segments that are one performance, saved twice
example_search     ranges of takes that are like an example, bent in time
"""
