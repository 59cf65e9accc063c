"""A zip of files that belong together: a glTF with its buffers, or one numbered OBJ or PLY for every frame.

zip_members   the members of the zip, by their use
read          reads them into one animation
obj, ply      the vertices and faces of one file
polygon_mesh  polygons, and their triangles
"""
