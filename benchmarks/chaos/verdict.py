"""What is wrong after a run: looked for in what the clients saw, in Redis, in the store, and among the processes."""

import time
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from benchmarks.chaos.client import Seen
from benchmarks.chaos.house import House
from benchmarks.timing.receiver import Receiver
from caesura.worker.queue.jobs import Jobs
from caesura.worker.retention.orphaned_blobs import delete_orphaned_blobs

QUIET_SECONDS = 300.0  # until the small jobs are done that nobody waits for


@dataclass
class Verdict:
    """Counts that must be zero are also `faults`, each a sentence."""

    counts: dict[str, int] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    retried: int = 0
    swept: int = 0

    def none(self, name: str, found: list[str]) -> None:
        """There must be none of these."""
        self.counts[name] = len(found)
        self.faults += [f"{name}: {one}" for one in found]

    def rows(self) -> list[str]:
        """The same as rows of a table."""
        return [
            f"| attempts that were lost and tried again | {self.retried} |",
            f"| blobs without a record, found and deleted by the sweep | {self.swept} |",
            *(f"| **{name}** | **{count}** |" for name, count in self.counts.items()),
        ]


def verdict(house: House, expected: int, seen: Seen, quiet: Seen | None, receiver: Receiver) -> Verdict:
    """Look everywhere, end the service, look for processes."""
    house.until_ready()
    jobs, said = house.jobs(), Verdict()
    said.counts["accounted for"] = len(seen.results)
    said.counts["clips fetched"] = len(seen.clips)
    said.none("lost", seen.lost)
    said.none("stuck", _stuck(jobs, expected, seen))
    said.none("duplicated", _duplicated(house, jobs, expected, seen))
    said.none("different from the quiet run", [] if quiet is None else _different(seen, quiet))
    said.none("unexplained answers", seen.wrong)
    said.retried = sum(
        record.attempt - 1
        for identifier, _, _ in seen.results.values()
        if (record := jobs.records.segmentations.one(identifier)) is not None
    )
    said.none("webhooks lost, or wrongly signed", _webhooks_lost(seen, receiver))
    said.none("leftover webhooks", _leftover_webhooks(jobs))
    said.none("leftover files", _leftover(house, jobs, said))
    said.none("orphan processes", [str(pid) for pid in house.stop()])
    return said


def _stuck(jobs: Jobs, expected: int, seen: Seen) -> list[str]:
    """What was never done, and what is still on its way when it should long be quiet."""
    deadline = time.monotonic() + QUIET_SECONDS
    while (jobs.records.segmentations.live() or any(jobs.queues.depths().values())) and time.monotonic() < deadline:
        time.sleep(0.2)
    live = [f"{record.id} is {record.status}" for record in jobs.records.segmentations.live()]
    queued = [f"{depth} jobs wait on {name}" for name, depth in jobs.queues.depths().items() if depth]
    missing = max(len(seen.results) - len(seen.clips) - len(seen.wrong), 0)
    live += ["clips were never made"] * missing
    missing = expected - len(seen.results) - len(seen.lost) - len(seen.wrong)
    return [*live, *queued, *(["a take was never done"] * max(missing, 0))]


def _duplicated(house: House, jobs: Jobs, expected: int, seen: Seen) -> list[str]:
    """More animations or segmentations than were sent, or a result that is another than its client has seen."""
    found = []
    animations = jobs.records.animations.uses()
    if len(animations) > expected:
        found.append(f"{len(animations)} animations of {expected} takes")
    found += [f"{name} was cut twice" for name in animations if len(jobs.records.segmentations.of(name)) > 1]
    with httpx.Client(base_url=house.url, trust_env=False, timeout=30) as http:
        for identifier, tag, content in seen.results.values():
            now = http.get(f"/v1/segmentations/{identifier}/result.json")
            if now.content != content or now.headers.get("ETag") != tag:
                found.append(f"{identifier} was done again after its client had seen it done")
    return found


def _different(seen: Seen, quiet: Seen) -> list[str]:
    """Results that are not, byte for byte, those of the run that was left in peace."""
    results = [
        f"take {number}"
        for number, (identifier, _, content) in seen.results.items()
        if number in quiet.results and (identifier, content) != (quiet.results[number][0], quiet.results[number][2])
    ]
    clips = quiet.clips
    return [*results, *(f"clips of take {n}" for n, found in seen.clips.items() if clips.get(n, found) != found)]


def _webhooks_lost(seen: Seen, receiver: Receiver) -> list[str]:
    """Segmentations that are done, and that the receiver was never told of."""
    done = [identifier for identifier, _, _ in seen.results.values()]
    receiver.wait_for(done, QUIET_SECONDS)
    return [*sorted(set(done) - receiver.told()), *(call.id for call in receiver.calls if not call.signed)]


def _leftover_webhooks(jobs: Jobs) -> list[str]:
    """What is still kept of calls that were made."""
    deadline = time.monotonic() + QUIET_SECONDS
    while (left := _webhook_keys(jobs)) and time.monotonic() < deadline:
        time.sleep(0.5)
    return left


def _webhook_keys(jobs: Jobs) -> list[str]:
    return [str(key) for kind in ("callbacks", "deliver") for key in jobs.redis.scan_iter(f"caesura:{kind}*")]


def _leftover(house: House, jobs: Jobs, said: Verdict) -> list[str]:
    """Files that nothing needs, once the sweep has looked twice."""
    blobs = house.blobs()
    before = dict(blobs.all())
    delete_orphaned_blobs(jobs.records, blobs, 0.0)
    delete_orphaned_blobs(jobs.records, blobs, 0.0)
    kept = dict(blobs.all())
    said.swept = len(before) - len(kept)
    stored = {str(path.relative_to(house.folder / "blobs")) for path in _files(house.folder / "blobs")}
    hidden = [f"blobs/{name}, which no listing shows" for name in stored - kept.keys()]
    return [*hidden, *(str(path) for path in _files(house.settings.scratch_dir))]


def _files(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file()]
