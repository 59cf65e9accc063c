"""All attacks on one service at once, while `/healthz` and the memory of the web process are watched.

    python -m benchmarks.attack                          # about two minutes; printed only
    TMPDIR=/mnt/small python -m benchmarks.attack --fill # and the disk is filled again and again: give it a small one

Ends with status 1 where a promise is missed. What each attack was answered is printed by status; `0` is a connection
that the service ended. Without `--fill`, that the disk is full is not tried.
"""

import argparse
import shutil
import sys
import threading
import time
from collections import Counter

from benchmarks.attack.attacks import ATTACKS, Target, fill, prepare
from benchmarks.load.crowd import polled
from benchmarks.load.measure import Measure, percentile, table
from benchmarks.timing.processes import Running, Watch, service

SECONDS = 60.0
MEGABYTE = 2**20
LARGEST_DISK = 8 * 2**30


def main() -> None:
    """Attack, print, and say by the status whether every promise is kept."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--seconds", type=float, default=SECONDS, help="how long all attacks run at once")
    options.add_argument("--fill", action="store_true", help="fill the disk, of at most 8 GB, that TMPDIR lies on")
    chosen = options.parse_args()
    with service() as running:
        data = running.redis.parent.parent
        if chosen.fill and shutil.disk_usage(data).total > LARGEST_DISK:
            options.error(f"{data} lies on a disk of more than 8 GB; set TMPDIR to a folder on a small one")
        measures, answers = attacked(running, chosen.seconds, chosen.fill)
    for name, counted in answers.items():
        sys.stdout.write(f"{name}: {', '.join(f'{n} x {status}' for status, n in sorted(counted.items())) or 'none'}\n")
    print(table(measures))
    sys.exit(0 if all(one.kept for one in measures) else 1)


def attacked(running: Running, seconds: float, filling: bool) -> tuple[list[Measure], dict[str, Counter[int]]]:
    """What was measured, and how often each attack was answered with each status."""
    target = Target(running.url, running.redis.parent.parent)
    prepare(target)
    attacks = {**ATTACKS, **({"a full disk": fill} if filling else {})}
    answers: dict[str, Counter[int]] = {name: Counter() for name in attacks}
    threads = [
        threading.Thread(target=attack, args=(target, answers[name]), daemon=True) for name, attack in attacks.items()
    ]
    watch = Watch(running.pid)
    with polled(running.url, "/healthz") as took:
        for thread in threads:
            thread.start()
        time.sleep(seconds)
        target.over.set()
        for thread in threads:
            thread.join()
    peak = watch.stop()["web"]
    failed = sum(counted[500] for counted in answers.values())
    return [
        Measure("/healthz, p50", percentile(took, 0.5), "ms"),
        Measure("/healthz, p99", percentile(took, 0.99), "ms"),
        Measure("/healthz, slowest", max(took), "ms", most=100),
        Measure("largest resident size of the web process", peak / MEGABYTE, "MB", most=400),
        Measure("answers of status 500", failed, most=0),
    ], answers


if __name__ == "__main__":
    main()
