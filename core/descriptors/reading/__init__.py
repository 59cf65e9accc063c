"""A block of frames, read tile by tile while each is in the cache."""
