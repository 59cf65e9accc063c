"""Several files, one after the other: what became of each, and how the command ends."""

import sys
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from caesura.core.control_characters import escape_control_characters
from caesura.core.document import SegmentationDocument
from caesura.core.errors import CaesuraError
from caesura.service.commands.problems import exit_code

BUG_MESSAGE = 1
"""The exit code where a file brought a fault of ours to light."""


@dataclass
class FileOutcome:
    """One file: its result, or what was wrong with it."""

    path: Path
    found: SegmentationDocument | None = None
    problem: Mapping[str, Any] | None = None


@dataclass
class Batch:
    """The outcomes so far, in order."""

    outcomes: list[FileOutcome] = field(default_factory=list)

    @contextmanager
    def file(self, path: Path) -> Iterator[FileOutcome]:
        """One file's work; whatever it raises is its outcome, and the next file has its turn."""
        outcome = FileOutcome(path)
        self.outcomes.append(outcome)
        try:
            yield outcome
        except CaesuraError as refused:
            outcome.problem = refused.problem()
        except MemoryError:
            outcome.problem = _problem("out-of-memory", "This file needs more memory than there is.")
        except OSError as refused:
            outcome.problem = _problem("file-system", f"It could not be read, or its results not written: {refused}.")
        except Exception:  # noqa: BLE001  a night's batch must not end at the first bug; it is shown, and told at the end
            traceback.print_exc(file=sys.stderr)
            outcome.problem = {"kind": "bug", "code": "internal-error", "detail": "A fault of Caesura's; it is above."}

    def exit_code(self) -> int:
        """0 where all went well, else the code of the first that did not."""
        for outcome in self.outcomes:
            if outcome.problem is not None:
                return BUG_MESSAGE if outcome.problem["kind"] == "bug" else exit_code(outcome.problem)
        return 0

    def table(self) -> str:
        """One line a file, then how many of them are done."""
        paths = [escape_control_characters(str(outcome.path)) for outcome in self.outcomes]
        names = max(map(len, ["file", *paths]))
        lines = [f"{'file':<{names}}  {'frames':>8}  {'seconds':>8}  motions  segments  least sure cut"]
        lines += [
            f"{path:<{names}}  {_cells(outcome)}".rstrip() for path, outcome in zip(paths, self.outcomes, strict=True)
        ]
        done = sum(outcome.found is not None and outcome.problem is None for outcome in self.outcomes)
        return "\n".join([*lines, "", f"{done} of {len(self.outcomes)} done"])


def _cells(outcome: FileOutcome) -> str:
    found = outcome.found
    if outcome.problem is not None or found is None:
        return f"failed: {(outcome.problem or {}).get('code', '')}"
    cuts = [segment.confidence for segment in found.segments[:-1] if segment.confidence is not None]
    sure = f"{min(cuts):14.0%}" if cuts else ""
    return f"{found.frames:8}  {found.duration_seconds:8.2f}  {found.motions:7}  {len(found.segments):8}  {sure}"


def _problem(code: str, detail: str) -> dict[str, Any]:
    return {"kind": "input", "code": code, "detail": detail}
