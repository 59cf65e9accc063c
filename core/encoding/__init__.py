"""Strain in 16 bits, turned from rows of frames to rows of triangles."""
