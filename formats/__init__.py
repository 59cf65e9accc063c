"""Files in, animations out, clips back. Bytes and buffers only: `caesura.api` and the commands open paths.

read                an animation from the bytes of an upload
file_header         takes and sizes from the header of a file
file_type           the format of a file, detected from its first bytes
gltf, bvh, npz      one folder for each format
bundle              zips: a glTF with its buffers, or a numbered OBJ or PLY for each frame
zip                 archives, checked and read, and written as streams
npy_header          the header of a NumPy array
clips               the same file cut into named clips
playback            the files that the page plays
kernels             compiled functions of sampling, posing and decoding
take_selection      which take the person asks for
time_range          the part of a take that is read
joined_takes        several takes, one after the other
frame_rate          the frame rate, estimated from key times
mesh_and_motion     a mesh in one file and its motion in another
vertex_sequence     frames of vertices stored as an array
decode_budget       how many bytes a file can decode to
strict_json         JSON as RFC 8259 defines it
buffer_file         a buffer read as a file
notices             what a reader assumed or left out
"""
