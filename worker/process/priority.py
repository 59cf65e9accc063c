"""Who goes first: work of seconds waits for work of milliseconds."""

import os

ANALYSE_NICE = 10


def lower_priority() -> None:
    """Let this process, and the threads it will have, work in what time the others leave.

    On a machine with nothing else to do it is as fast as before. Where the web process or a short job wakes up, it
    goes first, at once: nice 10 is a tenth of their share, and a batch process interrupts nobody.
    """
    os.nice(ANALYSE_NICE)
    if hasattr(os, "SCHED_BATCH"):
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
