"""A result as the paper's figures show one: the energy curve, its key-frames and cuts, the segments in colour."""
