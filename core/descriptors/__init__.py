"""What is measured of a body in each frame: one file a descriptor, one table of them.

table           the descriptors by name
strain          how far each triangle is stretched
pair_distances  how far points of the body are from each other
pair_strain     how far pairs of points are stretched, where there are no triangles
curvature       how much rounder or flatter the surface is than at rest
geodesic        the average distance along the surface
heat_kernel     the heat kernel signature
patch_means     the mean of a descriptor on each patch of the surface
"""
