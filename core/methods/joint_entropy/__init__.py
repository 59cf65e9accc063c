"""The paper's method (Luo et al. 2016): key-frames grouped by k-means, boundaries between groups by the energy curve.

method      the steps in order
clustering  key-frames into motions
boundaries  where one motion ends and the next begins
details     what it saw on its way, where that is asked for
"""
