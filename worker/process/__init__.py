"""Worker processes.

worker_pool      the workers of one machine
rq_worker        RQ's worker, as it is needed here
work_horse       the fork that does a job
worker_context   what a job works with
worker_registry  who works
warm_up          everything compiled and loaded before the first fork
job_quota        what one job may use of the machine
thread_count     how many threads a process may keep busy
priority         which processes go first
"""
