"""The commands of `caesura`. Heavy modules are imported when a command runs, so `--help` answers at once.

cli                                   the list of commands
segment, submit, score                segment files here, by a service, and compare with a truth
serve, worker, demo, keys             run the service, workers, the demo, and make API keys
options, file_arguments, outputs      options of the method, input files and output files
segment_table, progress_bar           what a terminal shows
batch, problems                       several files, errors and exit codes
client, local_service                 a service as a client sees it, and one for the time of a command
key_ring                              the API keys in Redis
labelling                             labels of frames, and their agreement
mapped_files                          files as memory
"""
