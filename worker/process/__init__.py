"""Worker processes.

worker_pool      the workers of one machine
rq_worker        RQ's worker with this project's heartbeat, lost jobs and work-horse
work_horse       the forked process that does a job
worker_context   settings, queue, records and store of a job
worker_registry  the list of living workers
warm_up          compiles and loads everything before the first fork
job_quota        memory and processor time of one job
thread_count     the number of threads of a process
priority         the priority of analysis against short jobs
"""
