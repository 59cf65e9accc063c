"""RQ workers: the only processes that load the numerics; and what the service asks of them and reads of them.

jobs, queues, errands    what is asked: segmentations and their states, RQ's queues, the small jobs beside them
records, schema, keys    what Redis holds of ours: reading and changing it, its form, its names
blobs                    what lies in files
tasks, attempt, place    what a job does, how it tells of that, and what it works with
pool, horses, horse      who does it: one process of a machine, its workers, the fork of a worker
watch, roster, lifeline  how nothing is stuck: what is lost, who is alive, and nobody outlives its parent
retention, forgetting    what is kept too long, and how it goes; orphans and leftovers are what nobody points to
"""
