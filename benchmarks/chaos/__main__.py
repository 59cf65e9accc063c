"""What is lost when everything is killed: nothing, or this command says what.

`python -m benchmarks.chaos` has 8 clients send 200 takes and fetch their clips twice: from a service that is left in
peace, and from one whose work-horses, workers, Redis, web process and supervisor get SIGKILL at random (seeded), and
whose clock jumps, and whose disk fills to the last byte and empties again, where this system lets us mount one. Then
it looks for what is lost, stuck, done twice, different, or left behind. Writes docs/operations.md; the exit status is 1
where anything is wrong.
"""

import argparse
import os
import random
import shutil
import signal
import sys
import time
from collections import Counter
from concurrent.futures import Future, ProcessPoolExecutor, wait
from contextlib import ExitStack, suppress
from multiprocessing import get_context
from pathlib import Path
from tempfile import mkdtemp

from benchmarks.chaos import client
from benchmarks.chaos.client import Seen
from benchmarks.chaos.disk import SmallDisk, small_disk
from benchmarks.chaos.house import House
from benchmarks.chaos.takes import takes
from benchmarks.chaos.verdict import Verdict, verdict
from benchmarks.reports.report import write_section
from benchmarks.timing.receiver import Receiver
from caesura.service.webhooks.signature import shown_secret
from caesura.worker.records import content_ids

DOCS = Path(__file__).resolve().parent.parent.parent / "docs" / "operations.md"
CLIENTS = 8
LONGEST_SECONDS = 900.0
BETWEEN_SECONDS = (0.3, 2.5)
MOST_KILLS = 80
DISK_BYTES = 5 * 2**20  # for each take
FULL_SECONDS = (0.5, 4.0)
FAULTS = ("disk", "clock")
"""Faults that are no process to kill."""
WEIGHTS = {"work-horse": 10, "worker": 4, "web": 4, "Redis": 3, "pool": 2, "supervisor": 2, "disk": 3, "clock": 4}


def main() -> None:
    """Run in peace, run under fire, compare, say."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--jobs", type=int, default=200)
    arguments.add_argument("--seed", type=int, default=7)
    arguments.add_argument("--print", action="store_true", help="print only")
    arguments.add_argument("--keep", action="store_true", help="leave the folders, and say where they are")
    chosen = arguments.parse_args()
    work = takes(chosen.jobs)
    folder = Path(mkdtemp(prefix="caesura-chaos-"))
    with ExitStack() as opened:
        opened.callback(shutil.rmtree, folder)
        disk: SmallDisk | None = None
        with suppress(PermissionError):
            disk = opened.enter_context(small_disk(folder / "fire", len(work) * DISK_BYTES))
        quiet, quiet_verdict, quiet_seconds, _ = _run(folder / "quiet", work, None)
        fire, found, seconds, kills = _run(folder / "fire", work, random.Random(chosen.seed), quiet, disk)
        if chosen.keep:
            opened.pop_all()
    lines = [
        "| under fire | |",
        "|---|---|",
        f"| takes, clients, seed | {chosen.jobs}, {CLIENTS}, {chosen.seed} |",
        f"| killed | {', '.join(f'{count} {name}' for name, count in kills.most_common() if name not in FAULTS)} |",
        f"| times the disk was full | {kills['disk']} |",
        f"| times the clock jumped, by hours or weeks | {kills['clock']} |",
        *(f"| {name} | {count} |" for name, count in sorted(fire.tally.items())),
        *found.rows(),
        f"| in peace, under fire | {quiet_seconds:.0f} s, {seconds:.0f} s |",
    ]
    print("\n".join(lines))
    if chosen.keep:
        print(f"kept in {folder}")
    if not chosen.print:
        write_section(DOCS, "chaos", "\n".join(lines))
    faults = [*(f"in peace: {fault}" for fault in quiet_verdict.faults), *found.faults]
    print("\n".join(faults))
    told = "; ".join(f"{count} {name}" for name, count in found.counts.items())
    print(f"{'WRONG' if faults else 'NOTHING LOST'}: {told}")
    sys.exit(1 if faults else 0)


def _run(
    folder: Path,
    work: list[bytes],
    chance: random.Random | None,
    quiet: Seen | None = None,
    disk: SmallDisk | None = None,
) -> tuple[Seen, Verdict, float, Counter[str]]:
    """One installation from its first start to its last process: what was seen, what is wrong, and how long it took."""
    folder.mkdir(exist_ok=True)
    house = House(folder)
    house.until_ready()
    began = time.monotonic()
    deadline = began + LONGEST_SECONDS
    numbered = list(enumerate(work))
    secret = content_ids.installation_secret(house.jobs().redis, house.settings.secret)
    receiver = Receiver(shown_secret(content_ids.webhook_secret(secret, "")))
    with ProcessPoolExecutor(CLIENTS, mp_context=get_context("spawn")) as clients:
        parts = [numbered[first::CLIENTS] for first in range(CLIENTS)]
        running = [clients.submit(client.run, house.url, part, deadline, receiver.url) for part in parts]
        kills = Counter[str]() if chance is None else _fire(house, chance, running, disk)
        seen = _together([one.result() for one in running])
    seconds = time.monotonic() - began
    found = verdict(house, len(work), seen, quiet, receiver)
    receiver.die()
    return seen, found, seconds, kills


def _fire(house: House, chance: random.Random, running: list["Future[Seen]"], disk: SmallDisk | None) -> Counter[str]:
    """Kill and fill until the clients have all they want, or it is enough; how many of which.

    Only while there are workers: who is killed faster than it can start shows nothing.
    """
    kills: Counter[str] = Counter()
    while wait(running, timeout=chance.uniform(*BETWEEN_SECONDS)).not_done:
        house.keep_up()
        there = {name: pids for name, pids in house.parts().items() if pids and name in WEIGHTS}
        if "worker" not in there or kills.total() >= MOST_KILLS:
            continue
        there["clock"] = []
        if disk is not None:
            there["disk"] = []
        name = chance.choices(list(there), [WEIGHTS[name] for name in there])[0]
        if disk is not None and name == "disk":
            disk.fill()
            time.sleep(chance.uniform(*FULL_SECONDS))
            disk.empty()
            kills[name] += 1
            continue
        if name == "clock":
            house.clock.jump(house.jobs().redis, chance)
            kills[name] += 1
            continue
        with suppress(ProcessLookupError):
            os.kill(chance.choice(there[name]), signal.SIGKILL)
            kills[name] += 1
    return kills


def _together(parts: list[Seen]) -> Seen:
    """What all clients saw."""
    seen = Seen()
    for part in parts:
        seen.results |= part.results
        seen.clips |= part.clips
        seen.lost += part.lost
        seen.wrong += part.wrong
        seen.tally += part.tally
    return seen


if __name__ == "__main__":
    main()
