"""The pass over the vertices: every block of frames is read once, and everything is measured while it is in the cache.

vertex_pass       the pass itself: blocks on threads, results in block order
block_statistics  what is measured on one block
range_estimate    how far coordinates go and how large strain gets, from a few frames
rest_pose         the pose that every frame is compared with
measured_body     the descriptor, its means on patches and the pair distances of one body
quantisation      strain in 16 bits, and the strain that counts as 1
histograms        counts of quantised strain
projection        descriptors on their leading components
features          the features of every frame
strain_at_peaks   the strain at the peaks of the energy curve
"""
