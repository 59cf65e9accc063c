"""Aligned cluster analysis: the similarity of two segments after one is aligned in time with the other.

aca, haca, spectral     the methods
temporal_reduction      runs of similar frames, each replaced by its mean
frame_kernel            the similarity of two frames
dynamic_time_alignment  the similarity of two segments
spectral_clustering     clusters by the leading eigenvectors of the similarity
short_runs              runs too short for a motion, given to their neighbours
initial_segmentation    the first segmentation, from similarity that persists
sample_rate             seconds as samples
segments                segments, and the bounds of their lengths
cluster_analysis        the alternation of segmentation and clustering until nothing changes (ACA)
hierarchy               the same in two levels (HACA)

Zhou, De la Torre and Hodgins, "Aligned cluster analysis for temporal segmentation of human motion", FG 2008, and
"Hierarchical aligned cluster analysis for temporal clustering of human motion", TPAMI 2013.
"""
