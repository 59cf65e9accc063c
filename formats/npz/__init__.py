"""Vertex sequences as NumPy archives: the headers of their members, checked without NumPy, and their arrays."""
