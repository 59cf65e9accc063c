"""The default method: switching k-means in several views, judged by a graph of like moments.

method             the steps in order
views              ways to look at one take: how long a window is, and how much each descriptor counts
windowed_signal    what is compared: window statistics, some ten times a second
window_statistics  mean, deviation and speed of the features in a window
initial_segments   the take cut where its features change
switching_k_means  the alternation: assign by Viterbi, take means, until nothing changes
short_segments     segments that only the blur of a window makes
transitions        what is too short to be a motion: the way from one to the next
neighbour_graph    moments, each linked to those most like it; the normalised cut of a labelling
subdivision        a motion seen by itself, which may be two
labellings         the motions of a take as one view shows them, judged by the graph
motion_count       the labelling of the least cut, and how many motions there are
frame_vote         cuts put where most labellings have them
refinement         cuts moved to the frame
cut_confidence     how sure each cut is
missed_cuts        where a cut may be missing
"""
