"""Poses of the SMPL body models, as AMASS stores them: read as a glTF of a skeleton, for the bodies are not free.

kinematic_tree   joints, their parents, and bones of lengths of our own
pose_members     the arrays of an archive of poses, by their headers alone
gltf_conversion  the poses as rotations of the nodes
"""
