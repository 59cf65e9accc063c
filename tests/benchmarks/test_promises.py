"""The small programs that measure what was promised: what they count."""

import sys
from importlib.util import find_spec

import numpy as np
import pytest

from benchmarks.counting import summary, verdict
from benchmarks.doubt import row, share_in_least_fifth
from benchmarks.edges import cases, outcome
from benchmarks.peers.peer_methods import NotInstalled, peers
from benchmarks.reports.cuts import JudgedCuts
from benchmarks.takes.sequences import Known
from caesura.core.analysis import Analysis, Features
from caesura.core.registry.methods import METHODS
from caesura.core.segmentation_document import Source


@pytest.mark.parametrize(
    ("true", "found", "said"), [(8, 8, "exact"), (30, 27, "within 10 %"), (8, 9, "+1"), (9, 8, "-1")]
)
def test_a_number_of_motions_is_exact_near_or_a_miss(true, found, said):
    """A tenth of the true number is near."""
    assert verdict(true, found) == said


def test_the_summary_counts_both():
    """Exact ones are within a tenth too."""
    assert summary([(8, 8), (30, 28), (4, 5)]).startswith("Exact on 1 of 3 takes, exact or within 10 % on 2")


def test_the_share_of_wrong_cuts_in_the_least_sure_fifth():
    """Two of the three wrong ones are among the two least sure of ten."""
    wrong = np.zeros(10, bool)
    wrong[[0, 1, 9]] = True
    assert share_in_least_fifth(np.arange(10.0), wrong) == pytest.approx(2 / 3)
    assert share_in_least_fifth(-np.arange(10.0), wrong) == pytest.approx(1 / 3)


def test_takes_without_a_wrong_cut_do_not_count_per_take():
    """Nor do those of fewer cuts than five; pooled, all do."""
    near, far = np.zeros(4), np.array([0.0, 0, 0, 9])
    fine = JudgedCuts(np.linspace(0.5, 1, 5), np.zeros(5), near, far, 1)
    poor = JudgedCuts(np.linspace(0, 1, 5), np.array([0.2, 0, 0, 0, 0]), np.array([0.2, 3, 0, 9]), far, 2)
    assert row("all", [fine, poor], 0.15) == "| all | 0.15 s | 10 | 1 | 100% | 100% of 1 | 100%, 11% | 3 | 2 of 3 |"


def test_every_edge_has_an_honest_answer_from_every_method():
    """A code or segments; anything else would have ended the program."""
    answers = {(name, m): outcome(animation, m, told) for name, animation, told in cases() for m in METHODS}
    assert {answers["one frame", m] for m in METHODS} == {"`no-motion`"}
    assert {answers["a coordinate that is no number", m] for m in METHODS} == {"`non-finite-data`"}
    assert all(answers["nothing moves", m].startswith("1 segment, `no-deformation`") for m in METHODS)


@pytest.mark.skipif(find_spec("ruptures") is not None, reason="it is installed here")
def test_a_peer_that_is_not_installed_is_named():
    """By its package; the table goes on without it."""
    values = np.random.default_rng(1).normal(size=(60, 3)).astype(np.float32)
    none = np.zeros(0, np.int64)
    source = Source(take=0, name="take", fps=30)
    analysis = Analysis(
        60, 30.0, source, {}, np.zeros(60), none, np.zeros((0, 0), np.float32), (Features("strain", values, 1.0),), 1.0
    )
    with peers(sys.executable) as others, pytest.raises(NotInstalled, match="not installed: ruptures"):
        others.labels("kernel-cpd", Known("take", "", analysis, np.repeat([0, 1], 30)))
