"""The geometry in the buffers of a glTF.

buffers       buffers and views of them
accessors     arrays from accessors
primitives    triangles and morph targets of a mesh
skin_weights  joints and weights of each vertex
gpu_instancing     instances of a mesh
"""
