"""The service under load, by real client processes: what it adds, how fast a new K is, how many reads it answers.

    python -m benchmarks.load             # minutes; writes docs/performance.md
    python -m benchmarks.load --quick     # under a minute; printed only
    python -m benchmarks.load --takes 1000 --large 20    # a crowd instead; writes docs/operations.md

Each starts a service of its own: web process, workers and the embedded Redis-compatible server. Ends with status 1
where a promise is missed.
"""

import argparse
import sys
from pathlib import Path

from redis import Redis

from benchmarks.load.busy import busy
from benchmarks.load.calls import Calls
from benchmarks.load.crowd import crowd
from benchmarks.load.measure import Measure, table
from benchmarks.load.overhead import overhead
from benchmarks.load.rates import rates
from benchmarks.load.slider import analysed, slider, stored_bytes
from benchmarks.reports.report import write_section
from benchmarks.timing.processes import service

DOCS = Path(__file__).resolve().parent.parent.parent / "docs"


def main() -> None:
    """Measure, print, write, and say by the status whether every promise is kept."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--quick", action="store_true", help="smaller and fewer; writes nothing")
    options.add_argument("--takes", type=int, default=0, help="so many takes of ten seconds, posted at once")
    options.add_argument("--large", type=int, default=0, help="and so many of five minutes among them")
    chosen = options.parse_args()
    if chosen.takes or chosen.large:
        page, section = "operations.md", "crowd"
        with service() as running:
            measures = crowd(running, chosen.takes, chosen.large)
    else:
        page, section = "performance.md", "load"
        measures = measured(chosen.quick)
    text = table(measures)
    print(text)
    if not chosen.quick:
        write_section(DOCS / page, section, text)
    sys.exit(0 if all(one.kept for one in measures) else 1)


def measured(quick: bool) -> list[Measure]:
    """Everything, by one service: first alone, then while its heavy worker is busy."""
    with service() as running, Calls(running.url) as calls, Redis(unix_socket_path=str(running.redis)) as redis:
        found = overhead(running.url, 5 if quick else 15)
        takes = analysed(calls, redis, 2 if quick else 5)
        result, others = stored_bytes(redis)
        found += [
            Measure("one demo take's result in Redis", result / 1024, "kB"),
            Measure("its other numbers of motions beside it", others / 1024, "kB"),
        ]
        shown = calls.cut_again(takes[0][0])["id"]
        with busy(running.url):
            found += slider(calls, takes)
            found += rates(running.url, shown, turns=2 if quick else 5)
    return found


if __name__ == "__main__":
    main()
