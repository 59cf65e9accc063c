"""The default method: switching k-means. A few motions, each a mean of windowed features, and a price on every change.

method             the steps in order
window_statistics  mean, deviation and speed of the features in a window
windowed_signal    what is compared: window statistics, each descriptor by its weight
feature_weights    the take under one weighting of its descriptors, and under all
initial_segments   the take cut where its features change
switching_k_means  the alternation: assign by Viterbi, take means, until nothing changes
separation         whether two motions are two
motion_count       how many motions there are
consensus          the weighting with which the others agree most
short_segments     what is too short to be a motion
refinement         cuts moved to the frame
cut_confidence     how sure each cut is
"""
