"""From sampled keys to vertices.

nodes     the node graph
skins     the joints and bind matrices of a skin
skeleton  the nodes that move a mesh
vertices  the vertices of any block of frames, morphed and skinned
"""
