"""`caesura segment --together`: the takes one after the other, then their motions, then what is written of each."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.segmentation_document import SegmentationDocument
from caesura.file_sources import open_parts
from caesura.formats.clips.clip_names import engine_safe_name
from caesura.mapped_files import scratch_buffer
from caesura.service.commands.exit_codes import exit_code, print_problem
from caesura.service.commands.file_segmentation import FileTask
from caesura.service.commands.terminal.progress_bar import ProgressBar
from caesura.worker.control_characters import escape_control_characters

if TYPE_CHECKING:
    from caesura.core.together.measured_take import MeasuredTake


def segment_files_together(tasks: Sequence[FileTask], folder: Path, *, as_json: bool) -> int:
    """Segment the files, write the results, and print a table; the exit code.

    A file that is bad, or of another body than the first good one, is named and left out.
    """
    from caesura.core.together.segment_together import segment_together
    from caesura.joint_segmentation import JointSegmentation
    from caesura.service.commands.joint.output import in_common_motions, joint_document, joint_table, write_joint

    done: list[tuple[FileTask, MeasuredTake, SegmentationDocument]] = []
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
    for task, measured, document in done:
        named = engine_safe_name(task.path.stem).replace("{", "").replace("}", "")
        options = task.outputs.options
        if "clips" in task.outputs.forms and "names" not in options.model_fields_set:
            options = options.model_copy(update={"names": f"{{motion}}_{named}_{{number}}"})
        outputs = replace(task.outputs, options=options)
        parts = open_parts([task.path, *(one for one in task.companions if one != task.path)])
        outputs.write(parts, in_common_motions(document, measured.name, found), task.target)
    write_joint(found, folder)
    if as_json:
        click.echo(json.dumps(joint_document(found.collection)))
    else:
        lines = joint_table(found.collection).split("\n")
        click.echo("\n".join(map(escape_control_characters, lines)))
    return code


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
