"""The pass over the vertices: it reads every block of frames once and measures it while the block is in the cache.

vertex_pass        the pass itself: blocks on threads, results in the order of the blocks
block_measurement  the measurements of one block
range_estimate     the range of coordinates and strain, estimated from a few frames
rest_pose          the rest pose, which every frame is compared with
body_size          the size of the body, taken out of every frame where it is not to count
descriptor_set     the descriptors, their patch means and the pair distances of one body
quantisation       strain in 16 bits, and the strain that counts as 1
projection         descriptors on their leading components
features           the features of every frame
strain_at_peaks    the strain at the peaks of the energy curve
"""
