"""Repetitions: three jumps in a row are one motion and three repetitions.

segment_features  what of a segment is compared with itself
neutral_pose      where a performer begins and ends each repetition
period            how long a repetition takes, by self-similarity
repetition_ends   where each repetition ends, for no two take equally long
repetitions       the repetitions of every segment of a take
loops             the whole repetitions that make the best loop
"""
