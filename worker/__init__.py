"""RQ workers: the only processes that load the method; and what the service asks of them and reads of them.

tasks            what a job does
result_files     files made of a result, and alternatives: other numbers of motions
queue            segmentations as jobs, RQ's queues, attempts and their progress
process          worker processes: the pool, the workers, their work-horses
records          what Redis holds
store            what lies in files
retention        what is kept too long, and how it goes
parent_watch     a process ends when its parent does
embedded_redis   a Redis-compatible server where none is given
settings, logs   what may be set, and log lines
"""
