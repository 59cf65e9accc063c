"""Which triangles exceed which level of strain in each frame, a bit each; and how many do so at two times at once."""
