"""Repeats: three jumps in a row are one motion and three repetitions.

passage   what of a segment is compared with itself
period    how long a repetition takes, by self-similarity
beats     where each repetition ends, for no two take equally long
repeats   the repetitions of every segment of a take
"""
