"""FBX of versions 5000 to 7700, text and binary, by way of ufbx: a scene that is evaluated, written as glTF.

gltf_conversion  the door: from an FBX to a GLB
read_in_child  in the reader's process: the steps of reading, in order
held_objects     how objects of the library have to be treated
nodes            transforms: pivots, orders of rotation and the inheritance of scale, as places in the parent
meshes           control points, faces and normals
skin             clusters of weights
blend_shapes     shapes and shapes between them
materials        colours
takes            animation stacks, sampled at the file's rate
"""
