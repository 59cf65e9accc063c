"""Vertex sequences as NumPy archives: their members' headers, judged without NumPy, and their arrays."""
