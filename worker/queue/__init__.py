"""Segmentations as jobs.

jobs               segmentations and their states
queues             RQ's queues
auxiliary_jobs     jobs other than segmentations
attempt            one attempt at one segmentation
progress_reporter  progress of an attempt, written in the background
orphaned_jobs      live segmentations without a worker, found and tried again
retry_delays       delays before another attempt
job_problems       problems that are not caused by the file
"""
