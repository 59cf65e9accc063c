"""Files cut together into the same motions.

segmentation  reads the files and cuts them
output        what is written of them
"""
