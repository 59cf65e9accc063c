"""The study of the paper's figure 5."""

from xml.etree import ElementTree

import numpy as np
import pytest

from benchmarks.paper.figure5 import STATED, TRIAL, Run, stated
from benchmarks.reports.drawing import drawn
from benchmarks.takes.cmu import Annotation, annotation, skinned
from caesura.core.segmentation import Segmentation
from caesura.core.segmentation_document import Source

TRUTH = Annotation(("walk", "clap", "walk"), (40, 70, 100), ((40, 40), (70, 70), (100, 100)))


def found(*cuts, labels=(0, 1, 0)):
    """A segmentation of 100 frames with these cuts."""
    return Segmentation(
        method="joint-entropy",
        algorithm="0",
        parameters={},
        source=Source(take=0, name="", fps=30),
        frame_rate=30.0,
        labels=np.repeat(labels, np.diff([0, *cuts, 100])),
        energy=np.linspace(0.5, 1, 100),
        key_frames=np.array([20, 50]),
        confidence=np.ones(len(cuts)),
    )


@pytest.mark.parametrize(
    ("cuts", "labels", "right"),
    [((38, 75), (0, 1, 0), True), ((38, 75), (0, 1, 2), False), ((5, 20), (0, 1, 0), False), ((40,), (0, 1), False)],
)
def test_reproducing_is_the_right_order_in_the_right_places(cuts, labels, right):
    """Another order does not count, nor the right order where the true motions are others."""
    assert Run.of(STATED, found(*cuts, labels=labels), TRUTH).reproduces(TRUTH) is right


def test_the_drawing_is_an_svg_with_both_bars():
    """Well formed, with one rectangle for each true and each found segment beside the background."""
    root = ElementTree.fromstring(drawn(found(40, 70), TRUTH))
    assert len(root.findall("{*}rect")) == 1 + 3 + 3
    assert len(root.findall("{*}circle")) == 2


def test_the_stated_setting_reproduces_figure_5(shared):
    """CMU 86_09 on our body: walk, look around, clap, stand and clap, walk."""
    folder = shared / "data" / "cmu86"
    truth = annotation((folder / "mocap.txt").read_text(), TRIAL)
    run = Run.of(STATED, stated(skinned(folder, TRIAL), truth), truth)
    assert run.reproduces(truth)
    assert run.accuracy > 0.9
