"""Frames of vertices: read in blocks or one by one, and checked.

blocks          blocks of frames, and a map over them on threads
sampled_frames  frames read and checked; which frames stand for all
buffer_pool     memory that is used again
"""
