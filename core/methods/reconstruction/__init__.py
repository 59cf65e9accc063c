"""Compared with: key-frames from which the frames between them can be made again.

genetic               key-frames of least error, bred by a genetic algorithm (the paper's [12])
curve_simplification  key-frames where the curve of poses strays most from what is drawn so far
reconstruction_error  how far frames are from those made of their key-frames
key_frame_motions     from key-frames to motions

Lee, Lin, Wang and Chen, "Animation key-frame extraction and simplification using deformation analysis", IEEE TCSVT
2008; Lim and Thalmann, "Key-posture extraction out of human motion data by curve simplification", EMBS 2001.
"""
