"""Files cut together into the same motions.

segmentation  reads the files and cuts them
output        what is written of them
motion_names  names that a person gives to common motions
renaming      a folder with motions called otherwise
"""
