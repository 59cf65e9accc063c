"""Point caches, PC2 and MDD: the places of the points of a mesh in every frame; its faces are in an OBJ beside them.

layout   how both lay out their numbers, checked without NumPy
header   the answer to an upload
read     the animation of both files
"""
