"""Aligned cluster analysis: segments are alike as far as one can be bent in time onto the other.

aca, haca, spectral     the methods
temporal_reduction      runs of like frames, each standing for itself
frame_kernel            how alike two frames are
dynamic_time_alignment  how alike two segments are
spectral_clustering     groups by the leading eigenvectors of their likeness
short_runs              runs too short to be motions, given to their neighbours
initial_segmentation    the first segmentation, from likeness that persists
sample_rate             seconds as samples
segments                segments, and how long they may be
cluster_analysis        the alternation: cut anew against the groups, until nothing changes (ACA)
hierarchy               the same in two levels (HACA)

Zhou, De la Torre and Hodgins, "Aligned cluster analysis for temporal segmentation of human motion", FG 2008, and
"Hierarchical aligned cluster analysis for temporal clustering of human motion", TPAMI 2013.
"""
