"""`caesura segment --together`: the takes one after the other, then their motions, then what is written of each."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import click

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import open_parts
from caesura.mapped_files import scratch_buffer
from caesura.service.commands.exit_codes import exit_code, print_problem
from caesura.service.commands.file_segmentation import FileTask
from caesura.service.commands.joint.motion_names import rename_motions
from caesura.service.commands.terminal.progress_bar import ProgressBar
from caesura.worker.control_characters import escape_control_characters

if TYPE_CHECKING:
    from caesura.core.together.measured_take import MeasuredTake
    from caesura.joint_segmentation import JointSegmentation

CutFile: TypeAlias = "tuple[FileTask, MeasuredTake, SegmentationDocument]"
"""A file, what is compared of it, and its own result."""


def segment_files_together(
    tasks: Sequence[FileTask], folder: Path | None, names: Mapping[str, str], *, as_json: bool
) -> int:
    """Segment the files, write the results with motions named anew, and print a table; the exit code.

    A file that is bad, or of another body than the first good one, is named and left out. Raises `UsageError` where no
    folder to write to is given.
    """
    from caesura.core.together.segment_together import segment_together
    from caesura.joint_segmentation import JointSegmentation
    from caesura.service.commands.joint.output import joint_document, joint_table

    if folder is None:
        raise click.UsageError("--together writes results of all files: it needs --out DIR beside it.")
    done: list[CutFile] = []
    code = 0
    for task in tasks:
        try:
            measured, document = _measure(task, folder)
            if done:
                _check_body(done[0][1], measured)
            done.append((task, measured, document))
        except CaesuraError as refused:
            code = code or exit_code(refused.problem())
            print_problem(refused.problem(), as_json=as_json, file=str(task.path))
        except OSError as fault:
            raise click.FileError(str(task.path), fault.strerror or str(fault)) from fault
    if not done:
        return code
    takes = tuple(measured for _, measured, _ in done)
    motions = tasks[0].parameters.motions
    found = JointSegmentation(segment_together(takes, motions), takes)
    try:
        found = JointSegmentation(rename_motions(found.collection, names), takes)
    except CaesuraError as refused:  # after hours of work: it is written all the same, and can be renamed
        refusal = print_problem(refused.problem(), as_json=as_json)
        code = code or refusal
    _write(done, found, folder)
    if as_json:
        click.echo(json.dumps(joint_document(found.collection)))
    else:
        lines = joint_table(found.collection).split("\n")
        click.echo("\n".join(map(escape_control_characters, lines)))
    return code


def _write(done: Sequence[CutFile], found: "JointSegmentation", folder: Path) -> None:
    """The results of each file in the common motions, then those of all."""
    from caesura.service.commands.joint.output import in_common_motions, take_outputs, write_joint

    sources: dict[str, list[Path]] = {}
    for task, measured, document in done:
        files = [task.path, *(one for one in task.companions if one != task.path)]
        named = in_common_motions(document, measured.name, found)
        take_outputs(task.outputs, task.path).write(open_parts(files), named, task.target)
        sources[measured.name] = files
    write_joint(found, folder, done[0][0].outputs, sources)


def _measure(task: FileTask, folder: Path) -> "tuple[MeasuredTake, SegmentationDocument]":
    """A take cut alone, by its own number of motions, and what is compared of it."""
    from caesura.core.pipeline import segment
    from caesura.core.together.measured_take import measure_take
    from caesura.formats.read import read_animation
    from caesura.worker.process.thread_count import available_threads

    with ProgressBar() as progress:
        progress("reading", 0.0)
        parts = open_parts([task.path, *(one for one in task.companions if one != task.path)])
        alone = task.parameters.model_copy(update={"motions": "auto"})
        animation = read_animation(parts, alone, Limits.none(), scratch_buffer)
        if animation.take.index >= 0:
            alone = alone.model_copy(update={"take": animation.take.index})
        found = segment(animation, alone, threads=task.threads or available_threads(), progress=progress)
        name = task.target.relative_to(folder).as_posix() if task.target is not None else task.path.stem
        return measure_take(name, animation, found.segments), found.document()


def _check_body(first: "MeasuredTake", other: "MeasuredTake") -> None:
    """Refuse a take of another body than the first."""
    from caesura.core.together.compared_body import ComparedBody

    ComparedBody.of([(first.name, first.poses), (other.name, other.poses)])
