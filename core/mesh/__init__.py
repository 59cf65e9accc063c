"""Meshes at rest: their points, edges, angles and pieces.

mesh             the welded mesh
welding          which vertices of a file are one point
edges, angles    the edges of a mesh, and the angles at its points and across its edges
edge_graph       the graph of edges that paths along the surface follow
laplacian        the cotangent Laplacian
farthest_points  points spread evenly over a shape
patches          the surface in pieces of about equal area
triangle_order   triangles near each other on the body, near each other in memory
"""
