"""Clips as files of the kind that was sent, a zip of one for each clip. The table of input formats names the writers.

animation_file the file of an upload that is the animation, out of its zip
clip_request   what a writer is given
stored_frames  which frames of the file a clip has
bvh_clips, point_cache_clips, numbered_mesh_clips, pose_clips, usd_clips  one file a format
"""
