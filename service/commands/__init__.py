"""The commands of `caesura`. Heavy modules are imported when a command runs, so `--help` answers at once.

cli                                   the list of commands
segment, submit, score                segment files here, by a service, and compare with a truth
compare, comparison                   compare the methods on labelled takes
serve, worker, demo, keys             run the service, workers, the demo, and make API keys
options, file_arguments, output_files  options of the method, input files and output files
terminal                              what a terminal shows
file_segmentation, batch              one file's work, and that of several
exit_codes                            errors and exit codes
local_service                         a service for the time of a command
joint                                 files cut together into the same motions; name them, find one
frame_labels, label_files             labels of frames and their agreement, and files of labels
"""
