"""A batch of files: the outcome of each, in order, and the exit code of the command."""

import multiprocessing
import os
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from types import FrameType

from caesura.core.progress import ignore_progress
from caesura.formats.native.confinement import end_with_parent
from caesura.service.commands.exit_codes import TERMINATED, exit_code
from caesura.service.commands.file_segmentation import FileOutcome, FileTask
from caesura.service.commands.terminal.progress_bar import ProgressBar
from caesura.worker.control_characters import escape_control_characters

END_SECONDS = 2.0
"""A process that is told to end may clear away after itself for so long."""


@dataclass
class Batch:
    """The outcomes so far, in order."""

    tasks: Sequence[FileTask]
    outcomes: list[FileOutcome] = field(default_factory=list)
    lost: int = 0
    """Processes that ended before their time."""

    def run(self, jobs: int) -> Iterator[FileOutcome]:
        """The outcome of each file in order, so many at once; a bad file does not stop the others."""
        for outcome in self._in_processes(jobs) if jobs > 1 else self._one_by_one():
            self.outcomes.append(outcome)
            yield outcome

    def _one_by_one(self) -> Iterator[FileOutcome]:
        for task in self.tasks:
            with ProgressBar() as progress:
                outcome = task.run(progress)
            yield outcome

    def _in_processes(self, jobs: int) -> Iterator[FileOutcome]:
        """Which of several files it was that a process was lost with, nobody knows: the rest is done one at a time."""
        while rest := self.tasks[len(self.outcomes) :]:
            try:
                yield from _in_pool(rest, min(jobs, len(rest)))
            except BrokenProcessPool:
                self.lost += 1
                if jobs == 1:
                    yield FileOutcome(self.tasks[len(self.outcomes)].path, problem=_lost_process())
                jobs = 1

    def exit_code(self) -> int:
        """0 where all went well, else the code of the first that did not."""
        return next((exit_code(one.problem) for one in self.outcomes if one.problem is not None), 0)

    def how_many(self) -> str:
        """How many of the files are done."""
        done = sum(outcome.found is not None and outcome.problem is None for outcome in self.outcomes)
        lost = "; a process was lost, and the rest done one at a time" if self.lost else ""
        return f"{done} of {len(self.tasks)} done{lost}"

    def table(self) -> str:
        """One line a file, then how many of them are done."""
        paths = [escape_control_characters(str(outcome.path)) for outcome in self.outcomes]
        names = max(map(len, ["file", *paths]))
        lines = [f"{'file':<{names}}  {'frames':>8}  {'seconds':>8}  motions  segments  least sure cut"]
        lines += [
            f"{path:<{names}}  {_cells(outcome)}".rstrip() for path, outcome in zip(paths, self.outcomes, strict=True)
        ]
        return "\n".join([*lines, "", self.how_many()])


def _cells(outcome: FileOutcome) -> str:
    found = outcome.found
    if outcome.problem is not None or found is None:
        return f"failed: {(outcome.problem or {}).get('code', '')}"
    cuts = [segment.confidence for segment in found.segments[:-1] if segment.confidence is not None]
    sure = f"{min(cuts):14.0%}" if cuts else ""
    return f"{found.frames:8}  {found.duration_seconds:8.2f}  {found.motions:7}  {len(found.segments):8}  {sure}"


def _in_pool(tasks: Sequence[FileTask], jobs: int) -> Iterator[FileOutcome]:
    """The outcomes in order; raises `BrokenProcessPool` at the first that a lost process has cost."""
    context = multiprocessing.get_context("spawn")  # a fork would inherit threads that nobody runs
    with ProcessPoolExecutor(jobs, context, initializer=_prepare_process, initargs=(os.getpid(),)) as pool:
        try:
            for future in [pool.submit(_run, task) for task in tasks]:
                yield future.result()
        except (KeyboardInterrupt, GeneratorExit):
            pool.shutdown(wait=False, cancel_futures=True)
            _end_processes()
            raise


def _prepare_process(parent: int) -> None:
    """Ctrl-C is for the command, which ends its processes in order, and whose own end is theirs."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent(parent)


def _run(task: FileTask) -> FileOutcome:
    """Do it; told to end, the process clears away what is half-written and does no other."""
    signal.signal(signal.SIGTERM, _leave)
    try:
        return task.run(ignore_progress)
    except SystemExit:
        os._exit(TERMINATED)
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _leave(_number: int, _frame: FrameType | None) -> None:
    raise SystemExit(TERMINATED)


def _end_processes() -> None:
    processes = multiprocessing.active_children()
    for process in processes:
        process.terminate()
    for process in processes:
        process.join(END_SECONDS)
        process.kill()


def _lost_process() -> dict[str, str]:
    detail = "Its process ended before its time; memory may have run out. Close other programs, and give it again."
    return {"kind": "input", "code": "process-lost", "detail": detail}
