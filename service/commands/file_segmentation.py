"""One file's work: read, cut, write; and what came of it."""

import sys
import traceback
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import open_parts
from caesura.mapped_files import scratch_buffer
from caesura.service.commands.exit_codes import system_problem
from caesura.service.commands.file_arguments import STANDARD, read_standard_input
from caesura.service.commands.output_files import Outputs


@dataclass
class FileOutcome:
    """One file: its result, or what was wrong with it."""

    path: Path
    found: SegmentationDocument | None = None
    problem: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class FileTask:
    """One animation, the files that may belong to it, and what is to be made of it; it can be sent to a process."""

    path: Path
    companions: tuple[Path, ...]
    parameters: Parameters
    outputs: Outputs
    target: Path | None
    threads: int | None

    def run(self, progress: Progress) -> FileOutcome:
        """Do it; whatever it raises is its outcome, but for Ctrl-C and for a reader of the output that has gone."""
        outcome = FileOutcome(self.path)
        try:
            outcome.found = self._segment(progress)
        except CaesuraError as refused:
            outcome.problem = refused.problem()
        except MemoryError:
            detail = "This file needs more memory than there is."
            outcome.problem = {"kind": "input", "code": "out-of-memory", "detail": detail}
        except BrokenPipeError:
            raise
        except OSError as fault:
            outcome.problem = system_problem(fault)
        except Exception:  # noqa: BLE001  a night's batch must not end at the first bug; it is shown, and told at the end
            traceback.print_exc(file=sys.stderr)
            outcome.problem = {"kind": "bug", "code": "internal-error", "detail": "A fault of Caesura's; it is above."}
        return outcome

    def _segment(self, progress: Progress) -> SegmentationDocument:
        """What is heavy is imported here, and what computes only for a good file."""
        from caesura.formats.read import read_animation

        progress("reading", 0.0)
        parts = self._parts()
        animation = read_animation(parts, self.parameters, Limits.none(), scratch_buffer)

        from caesura.core.pipeline import segment
        from caesura.worker.process.thread_count import available_threads

        parameters = self.parameters
        if animation.take.index >= 0:  # as in the service's documents; several takes in one are "all"
            parameters = parameters.model_copy(update={"take": animation.take.index})
        threads = self.threads or available_threads()
        found = segment(animation, parameters, threads=threads, progress=progress).document()
        self.outputs.write(parts, found, self.target)
        return found

    def _parts(self) -> dict[str, memoryview]:
        if self.path == STANDARD:
            return {"": read_standard_input()} | open_parts(list(self.companions))
        return open_parts([self.path, *(one for one in self.companions if one != self.path)])
