"""Segmentations as jobs.

jobs               segmentations and their states
queues             RQ's queues
auxiliary_jobs     jobs other than segmentations
attempt            one attempt at one segmentation
progress_reporter  how far an attempt is
overall_progress   how much of all its stages is done, and how long the rest takes
orphaned_jobs      live segmentations that nobody works on, found and tried again
job_problems       what can go wrong that is not the file's fault
"""
