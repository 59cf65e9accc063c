"""The method: arrays and frozen values in and out. No files, HTTP, Redis, clock or environment.

pipeline, parameters      the steps in order, and what a person can choose
animation                 the input: frames of vertices, and the triangles between them
mesh, descriptors         meshes at rest, and what is measured on them: strain, pair distances, curvature, …
frames                    frames of vertices, read in blocks
block_pass                the one pass over the vertices, block by block
energy                    joint entropy, the energy curve, its key-frames
methods                   from an analysis to cuts and motions: one folder a family
registry                  methods and descriptors by name, one line each
repetition                the repetitions inside every segment
together                  one set of motions over several takes, and search by example
analysis                  what is computed once from the vertices
segmentation              the result of one cut of an analysis
feature_sequence          segmentation of features alone, without vertices
segmentation_document     the result as JSON
revision                  changes that a person makes to the result
agreement                 how well two labellings agree
plot                      the result as a picture
kernels                   all compiled functions
errors, limits            errors in the input, and how large it can be
progress                  reports of progress
single_threaded_blas      BLAS and OpenMP on one thread
"""
