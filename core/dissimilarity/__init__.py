"""Segments in which every pair of frames is alike, as the paper's predecessor cuts deforming meshes.

partition  the segments of least average distance within
grouping   segments into motions, by the average distance between them
"""
