"""The takes of a glTF, and their values at any time.

take_choice   which animation is the take
channels      the channels of an animation
glb_key_times key times read from a GLB in small pieces
sampling      interpolation of the keys
sampled_take  the frames of one take, or of all takes joined
"""
