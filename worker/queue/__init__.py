"""Segmentations as jobs.

jobs               segmentations and their states
queues             RQ's queues
auxiliary_jobs     jobs that are no segmentation
attempt            one attempt at one segmentation
progress_reporter  how far an attempt is
orphaned_jobs      live segmentations that nobody works on, found and tried again
retry_delays       pauses before another attempt
job_problems       what can go wrong that is not the file's fault
"""
