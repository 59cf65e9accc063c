"""Files in, animations out, clips back. Bytes and buffers only: what opens paths is above.

read, header        the two doors: an animation from bytes, and what the headers alone say
file_type           what kind of file it is, by its first bytes
gltf, bvh, npz, bundle  one folder a format; `zip` reads and writes the archives
npy_header        the header of a NumPy array
clips               the same file cut into named clips
playback            what the page plays
kernels             compiled functions of sampling, posing and decoding
take_selection      the take that is meant
time_range          the part of a take that is read
joined_takes        several takes, one after the other
frame_rate          the rate of the keys
mesh_and_motion     a mesh in one file, its motion in another
vertex_sequence     frames of vertices that lie somewhere as an array
notices             what a reader assumed or left out
"""
