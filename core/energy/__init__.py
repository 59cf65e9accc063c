"""From quantised strain to key-frames.

joint_entropy  the joint entropy of the strains at two times
energy_curve   the energy of every frame
frame_distance the ablation: plain distances of frames
key_frames     the peaks of the curve
"""
