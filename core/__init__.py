"""The method: arrays and frozen values in and out. No files, HTTP, Redis, clock or environment.

pipeline, parameters      the steps in order, and what a person may choose
animation                 what goes in: frames of vertices, and the triangles between them
mesh, descriptors         meshes at rest, and what is measured on them: strain, pair distances, curvature, …
frames                    frames of vertices, read in blocks
block_pass                the one pass over the vertices, block of frames by block of frames
energy                    joint entropy, the energy curve, its key-frames
methods                   from an analysis to cuts and motions: one folder a family, one table of all
repetition                the repetitions inside every segment
analysis, segmentation    what is computed once from the vertices, and what every cut of it gives
document, revision        the result as JSON, and what people change in it
agreement                 how well two labellings agree
plot                      the result as a picture
kernels                   all compiled functions
errors, limits, progress  what can be wrong, how much is allowed, how far the work is
"""
