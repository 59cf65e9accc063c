"""RQ workers: the only processes that load the method. Also what the service needs of jobs, records and files.

tasks                the work of each job
result_file_writers  files made of a result
stored_alternatives  stored results for other numbers of motions
queue                segmentations as jobs, RQ's queues, attempts and their progress
process              worker processes: the pool, the workers, their work-horses
records              the records in Redis
store                uploads, analyses and other files
retention            deletion of what is too old
clock_check          whether the clock is steady enough to delete by age
parent_watch         a process ends when its parent does
embedded_redis       a Redis-compatible server where none is given
private_folder       the data folder, closed to other users
settings, logs       settings, and log lines
control_characters   control characters, escaped for terminals and logs
"""
