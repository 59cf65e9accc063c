"""Alembic (Ogawa) by way of alembic3d: meshes whose vertices are stored for every sample, read as a vertex sequence.

read       the door: from an Alembic to an animation
read_in_child  in the reader's process: the steps of reading, in order
objects    the meshes of an archive, and the transforms above them
samples    when the samples of a property are, and its values in between
header     what an upload is answered with
"""
