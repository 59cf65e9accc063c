"""Frames of vertices: read in blocks or one by one, and checked.

blocks          blocks of frames, and a map over them on threads
vertex_rows     vertices with the frames innermost in memory
sampled_frames  frames read and checked; which frames stand for all
"""
