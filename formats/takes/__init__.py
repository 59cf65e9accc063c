"""Takes of a file: their frame rate, the one that is asked for, and the part of it that is read."""
