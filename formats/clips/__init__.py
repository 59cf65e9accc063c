"""What comes out: the uploaded file with one named animation a segment, or with its key poses.

write                    the door: an upload and its segmentation in, a file out
clip_options, clip_plan  how clips are made of segments, and which there will be
clip_names               names that engines and file systems accept
gltf_clips, npz_clips    clips of a glTF, and of a vertex sequence
key_poses                an animation that steps from key pose to key pose
"""
