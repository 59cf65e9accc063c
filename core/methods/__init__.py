"""The methods: from an analysis to cuts and motions. One folder a family; `core.registry` lists them.

switching       the default: switching k-means in several views
sheets          the default on a timeline of clips laid end to end
joint_entropy   the paper's: key-frames grouped by k-means
alignment       compared with: aligned cluster analysis in one level and two, spectral clustering
luo2014         compared with: segments of least dissimilarity
compared_methods what the compared methods share
pose_features   all descriptors of a frame side by side
"""
