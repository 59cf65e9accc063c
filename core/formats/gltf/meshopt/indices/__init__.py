"""The codecs of triangles and of other indices."""
