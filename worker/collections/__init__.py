"""Collections: many takes in the same motions. What is light is asked by the web process too.

common_motions   motions that are added to a collection, their names and colours; light
corrected_takes  segments as people set them, which the program leaves; light
stored_space     the pose space of a collection, as a blob
take_files       what a take is compared by: measured once, and read again
joint_cut        all takes cut together
take_measuring   takes that wait, measured once each is analysed
known_motions    the motions of a collection as the method has them
space_learning   the pose space learned anew, as takes come
take_labelling   takes that wait, labelled by the motions that are known
proposals        a new cut of all takes, or what a correction says of the others, to be looked at
collection_index what is searched of a collection, kept by the process
example_search   ranges of takes that are like an example
"""
