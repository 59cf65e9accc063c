"""Files in, animations out, clips back. Bytes and buffers only: `caesura.api` and the commands open paths.

read, header        the two doors: an animation from bytes, and what the headers alone say
input_formats       the input formats by name: one table of them
file_type           what kind of file it is, by its first bytes
gltf, bvh, npz, bundle  one folder a format; `zip` reads and writes the archives
npy_header        the header of a NumPy array
clips               the same file cut into named clips
exports             the files made of a result: one table of them
written_file        a file that is written piece by piece
playback            what the page plays
kernels             compiled functions of sampling, posing and decoding
take_selection      which take the person asks for
time_range          the part of a take that is read
joined_takes        several takes, one after the other
frame_rate          the frame rate, estimated from key times
mesh_and_motion     a mesh in one file and its motion in another
vertex_sequence     frames of vertices stored as an array
decode_budget       how many bytes a file can decode to
strict_json         JSON as RFC 8259 defines it
notices             what a reader assumed or left out
"""
