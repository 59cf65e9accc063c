"""USD (text, crate and package) by way of usd-core: a stage of one layer, read as glTF or as frames of vertices.

read         the door: from a USD to an animation
usdz         the layer that a package begins with
layer        in the reader's process: one layer, without what it refers to outside, and with bounded references inside
read_in_child  the steps of reading, in order
frame_times  the frames of a stage
meshes_and_skeletons  the meshes and skeletons of a stage, and what the library computes of them
transforms   matrices as translation, rotation and scale
gltf_conversion  meshes, skeletons and blend shapes as glTF, which clips keep
vertices     what glTF cannot hold, as frames of vertices
stage_cut    parts of a stage as layers of their own
header       what an upload is answered with
"""
