"""`caesura demo`: two figures whose motions are known, through the running service."""

import signal
from contextlib import suppress
from itertools import zip_longest

import click

from caesura.core.segmentation_document import Segment, SegmentationDocument
from caesura.service.commands.exit_codes import Command
from caesura.service.commands.frame_labels import Labelling, compute_agreement
from caesura.service.commands.terminal.progress_bar import ProgressBar
from caesura.worker.control_characters import escape_control_characters

GOOD_ACCURACY = 0.95


@click.command(cls=Command, short_help="Segment two sample figures, and open them in the page.")
@click.option("--once", is_flag=True, help="End after printing.")
@click.option("--port", type=click.IntRange(0, 65535), default=8000, show_default=True, help="Port; 0: any free one.")
@click.option("--url", help="A service that is running already; without it, one is started here.")
@click.pass_context
def demo(context: click.Context, /, once: bool, port: int, url: str | None) -> None:
    """Segment two sample figures, compare with what they do, and leave the page open.

    The figures are made here, motion by motion, so their truth is known exactly. Everything goes through the
    service's API, as any other client would. The exit code is 1 where a figure's frame accuracy is below 0.95.
    """
    from caesura.service.commands.local_service import local_service

    if url:
        accuracy = _segment_samples(url)
    else:
        click.echo("Starting the service; the first start compiles its kernels, which takes a minute or so.", err=True)
        with local_service(port) as started:
            accuracy = _segment_samples(started)
            if not once:
                click.echo(f"Drop files of your own on {started} ; Ctrl-C ends it.")
                with suppress(KeyboardInterrupt):
                    signal.pause()
    context.exit(0 if accuracy >= GOOD_ACCURACY else 1)


def _segment_samples(url: str) -> float:
    """Upload, wait, compare and print, for each figure; the lowest frame accuracy."""
    from caesura.client.client import Client
    from caesura.samples.sample_figures import FIGURES, build_figure

    accuracies = []
    with Client(url) as client:
        for name in FIGURES:
            sample = build_figure(name)
            truth = Labelling.of(sample.truth.document())
            motions = len({label for _, _, label in truth.segments})
            with ProgressBar() as progress:
                found = client.segment(sample.glb, name=f"{name}.glb", progress=progress, motions=motions)
            accuracy = compute_agreement(Labelling.of(found.model_dump()), truth)["frame_accuracy"]
            click.echo(_compare_with_truth(name, found, truth))
            click.echo(f"  frame accuracy {accuracy:.3f}, given the number of motions, {motions}")
            click.echo(f"  {url}/view/{found.id}\n")
            accuracies.append(accuracy)
    return min(accuracies)


def _compare_with_truth(name: str, found: SegmentationDocument, truth: Labelling) -> str:
    """Segments beside the truth, in order."""
    rows = [f"{name} figure, {found.frames} frames at {found.frame_rate:g} a second", ""]
    rows.append(f"  {'truth':<32}found")
    for given, segment in zip_longest(truth.segments, found.segments):
        rows.append(
            f"  {_seconds_span(*given) if given else '':<32}{_describe_segment(segment) if segment else ''}".rstrip()
        )
    return "\n".join(rows)


def _describe_segment(segment: Segment) -> str:
    return _seconds_span(segment.start, segment.end, segment.name)


def _seconds_span(start: int, end: int, label: str) -> str:
    return f"{start:>5} … {end:>5}  {escape_control_characters(label)}"
