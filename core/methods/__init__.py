"""The methods: from an analysis to cuts and motions. One folder a family, one table of all.

table           the methods by name
switching       the default: switching k-means on windowed features
joint_entropy   the paper's: key-frames grouped by k-means
alignment       compared with: aligned cluster analysis in one level and two, spectral clustering
luo2014         compared with: segments of least dissimilarity
comparison      what the compared methods share
pose_features   all descriptors of a frame side by side
"""
