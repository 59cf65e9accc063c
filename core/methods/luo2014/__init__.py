"""Segments in which every pair of frames is alike, as the paper's predecessor cuts deforming meshes.

method            the steps in order
partition         the segments of least average distance within
segment_grouping  segments into motions, by the average distance between them
"""
