"""From sampled keys to vertices.

node_graph      the node graph
skins           the joints and bind matrices of a skin
skeleton        the nodes that move a mesh
posed_vertices  the vertices of any block of frames, morphed and skinned
joints_of_mesh  the joints of the skeleton that moves them
"""
