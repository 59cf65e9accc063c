"""Files that belong together: a glTF with its buffers, a point cache with its mesh, one OBJ or PLY for every frame.

zip_members     the members of a zip, by their use
companion_file  the file that must lie beside another
read            reads numbered shapes into one animation
polygon_mesh    the vertices and triangles of one OBJ or PLY
"""
