"""No orphans: a process that ends when the one that started it does, however that one ended.

Linux sends the child a signal (prctl PR_SET_PDEATHSIG) when the *thread* that created it ends, so children are
started from the main thread only. Elsewhere a child has to look for itself: `parent_is_gone`.
"""

import ctypes
import os
import signal
import sys
import threading
from collections.abc import Callable

PR_SET_PDEATHSIG = 1

_prctl = ctypes.CDLL(None).prctl if sys.platform == "linux" else None


def end_with_parent(parent: int, by: signal.Signals = signal.SIGKILL) -> None:
    """Call in a new child: let it get `by` once the process `parent`, which made it, has ended."""
    if _prctl is not None:
        _prctl(PR_SET_PDEATHSIG, by)
    if parent_is_gone(parent):  # it ended before the call
        os.kill(os.getpid(), by)


def parent_watch(by: signal.Signals = signal.SIGKILL) -> Callable[[], None]:
    """`die_with` the calling process, as `subprocess.Popen(preexec_fn=…)` takes it."""
    if threading.current_thread() is not threading.main_thread():
        raise RuntimeError("start children from the main thread: their life hangs on the thread that made them")
    parent = os.getpid()
    return lambda: end_with_parent(parent, by)


def parent_is_gone(parent: int) -> bool:
    """Whether the calling process has been left by the process that made it."""
    return os.getppid() != parent
