"""C3D: the places of optical markers, read as a glTF of a node for each.

number_encodings integers and reals of the three kinds of processors
point_data_layout  where what lies, by the head and the parameters, without NumPy
header           the answer to an upload
markers          the places of the markers, their gaps filled
gltf_conversion  the markers as a tree of nodes
"""
