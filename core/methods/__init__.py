"""The methods: from an analysis to cuts and motions. One folder a family; `core.registry` lists them.

switching       the default: switching k-means in several views
sheets          the default on a timeline of clips laid end to end
joint_entropy   the paper's: key-frames grouped by k-means
alignment       compared with: aligned cluster analysis in one level and two, spectral clustering
luo2014         compared with: segments of least dissimilarity
barbic2004      compared with: principal components, probabilistic ones, and a mixture of Gaussians
hidden_markov   compared with: a hidden Markov model of windows
velocity_minima compared with: cuts where the body all but stops
reconstruction  compared with: key-frames of which the others can be made again
segment_groups  segments that are alike as one motion
comparison_steps what the compared methods share
pose_features   all descriptors of a frame side by side
"""
