"""Files in, animations out, clips back. Bytes and buffers only: `caesura.api` and the commands open paths.

read, upload_summary  the two doors: an animation from bytes, and what the headers alone say
input_formats       the input formats by name: one table of them
file_type           what kind of file it is, by its first bytes
gltf, bvh, asf, c3d, npz, smpl, point_cache, bundle  one folder a format; `zip` reads and writes the archives
native              readers of native code, each in a process of its own
npy_header        the header of a NumPy array
clips               the same file cut into named clips
exports             the files made of a result: one table of them
streamed_file       a file that is written piece by piece
playback            what the page plays
kernels             compiled functions of sampling, posing and decoding
takes               frame rates, the take that is asked for, the part of it that is read
vertex_sequence     frames of vertices stored as an array
decode_budget       how many bytes a file can decode to
notices             what a reader assumed or left out
"""
