"""Files cut together into the same motions.

segmentation  reads the files and cuts them
output        what is written of them
find          the subcommand that searches them
rename        the subcommand that names their motions
motion_names  names that a person gives to common motions
renaming      a folder with motions called otherwise
"""
