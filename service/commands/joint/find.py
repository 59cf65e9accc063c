"""`caesura find`: where takes that were cut together hold the motion of an example."""

import json
from dataclasses import asdict
from pathlib import Path

import click

from caesura.service.commands.exit_codes import Command
from caesura.service.commands.joint.output import COLLECTION
from caesura.worker.control_characters import escape_control_characters

FOLDER = click.Path(exists=True, file_okay=False, path_type=Path)


@click.command(cls=Command, short_help="Find a motion in takes that were cut together.")
@click.argument("example", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--in", "folder", required=True, type=FOLDER, help="The folder that `segment --together --out` wrote.")
@click.option("--start", type=click.FloatRange(0), help="Seconds where the example begins in its file.")
@click.option("--end", type=click.FloatRange(0, min_open=True), help="Seconds where it ends.")
@click.option("--most", type=click.IntRange(1, 10_000), default=20, show_default=True, help="Ranges at most.")
@click.option("--json", "as_json", is_flag=True, help="Print the ranges as JSON.")
def find(example: Path, folder: Path, start: float | None, end: float | None, most: int, as_json: bool) -> None:
    """Find the motion of EXAMPLE, a file of the same body, in the takes of a folder.

    Ranges of frames come the most alike first, bent in time: as fast as the example, up to twice, or down to half. The
    distance is 0 for the same motion.
    """
    from caesura.joint_segmentation import JointSegmentation
    from caesura.worker.process.thread_count import available_threads

    stored = folder / COLLECTION
    if not stored.is_file():
        raise click.UsageError(f"'{folder}' holds no takes to search: make it with caesura segment --together --out.")
    joint = JointSegmentation.from_bytes(stored.read_bytes())
    found = joint.find_example(example, most, start=start or 0.0, end=end, threads=available_threads())
    rates = {take.name: take.frame_rate for take in joint.collection.takes}
    if as_json:
        ranges = [asdict(one) | {"seconds": one.start / rates[one.take]} for one in found]
        click.echo(json.dumps(ranges))
        return
    width = max((len(one.take) for one in found), default=4)
    click.echo(f"{'take':<{width}}  {'frames':>15}  {'seconds':>19}  distance")
    for one in found:
        seconds = f"{one.start / rates[one.take]:>8.2f} … {one.end / rates[one.take]:>8.2f}"
        frames = f"{one.start:>6} … {one.end:>6}"
        side = "  mirrored" if one.mirrored else ""
        line = f"{one.take:<{width}}  {frames}  {seconds}  {one.distance:8.3f}{side}"
        click.echo(escape_control_characters(line))
