"""The methods: from an analysis to cuts and motions. One folder for each family, one table of all.

table             the methods by name
switching         the default: switching k-means on windowed features
joint_entropy     the paper's: key-frames clustered by k-means
alignment         for comparison: aligned cluster analysis in one level and two, spectral clustering
luo2014           for comparison: segments of least dissimilarity
compared_methods  the steps that the methods for comparison share
pose_features     all descriptors of a frame side by side
"""
