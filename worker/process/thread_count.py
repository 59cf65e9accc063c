"""How many threads this process may keep busy."""

import math
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

CGROUP = Path("/sys/fs/cgroup")
OWN = Path("/proc/self/cgroup")


def available_threads(cgroup: Path = CGROUP, own: Path = OWN) -> int:
    """The processors that affinity allows, and no more than the cgroups' quotas pay for (rounded up)."""
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    quota = min((quota for group in _groups(cgroup, own) if (quota := _quota(group)) is not None), default=None)
    return allowed if quota is None else max(1, min(allowed, math.ceil(quota)))


def _groups(cgroup: Path, own: Path) -> Iterator[Path]:
    """The cgroup of this process and those above it. In a container only the topmost can be seen: it is its own."""
    yield from (cgroup, cgroup / "cpu")
    with suppress(OSError):
        for line in own.read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            if controllers and "cpu" not in controllers.split(","):
                continue
            steps = path.strip("/").split("/")
            for depth in range(len(steps)):
                yield Path(cgroup, *(["cpu"] if controllers else []), *steps[: depth + 1])


def _quota(group: Path) -> float | None:
    """Processors' worth of time per period: cgroup v2's `cpu.max`, else v1's pair; None where nothing is set."""
    try:
        quota, period = (group / "cpu.max").read_text().split()
    except (OSError, ValueError):
        try:
            quota = (group / "cpu.cfs_quota_us").read_text().strip()
            period = (group / "cpu.cfs_period_us").read_text().strip()
        except OSError:
            return None
    return None if quota in {"max", "-1"} else int(quota) / int(period)
