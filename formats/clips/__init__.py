"""The output files: the uploaded file with one named animation for each segment, or with its key poses.

write_clips                  entry point: an upload and its segmentation in, a file out
clip_options, clip_plan      the options, and the list of clips that follows from them
clip_names                   names that engines and file systems accept
clip_source                  the parts of a file that every clip copies
loop_choice, loop_channel    which segments are cut to their best loops, and how a loop is closed
gltf_clips, npz_clips        clips of a glTF, and of an NPZ
in_kind                      clips of other formats, as files of the kind that was sent
key_poses                    an animation that steps from key pose to key pose
take_ranges                  which frames of a result belong to which take
take_channels, channel_keys  the channels of a take, and their decoded keys
channel_cut                  a part of a channel with the same motion
rotation_spline              unit quaternions at the cut ends of a spline
animation_replacement        a glTF with some animations replaced
self_contained_gltf          a glTF with all buffers and images in one file
buffer_references            the accessors, views and bytes that are in use
binary_chunk                 the binary chunk of the new file
"""
