"""The methods compared with are those of their authors: on their features, their figures."""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from benchmarks.paper.aca_authors import AUTHORS, METHODS, REDUCED_BY, TRIALS, row
from benchmarks.takes.joint_angles import JOINTS, joint_angles, true_motions
from caesura.core.agreement import frame_accuracy
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.temporal_reduction import reduce_frames


def test_features_are_half_the_rotation_vector_of_every_joint():
    """A quarter turn about z is (0, 0, π/4); a joint of one angle turns about x; x turns first."""
    angles = dict.fromkeys(JOINTS, "0 0 0") | {"lowerback": "0 0 90", "rradius": "60", "head": "90 0 90"}
    found = joint_angles("\n".join(["1", "root 1 2 3 4 5 6", *(f"{j} {a}" for j, a in angles.items())]))
    found = found.reshape(len(JOINTS), 3)
    turned = {j: found[JOINTS.index(j)] for j in JOINTS}
    np.testing.assert_allclose(turned["lowerback"], [0, 0, np.pi / 4], atol=1e-12)
    np.testing.assert_allclose(turned["rradius"], [np.pi / 6, 0, 0], atol=1e-12)
    np.testing.assert_allclose(turned["head"], np.full(3, np.pi / 3 / np.sqrt(3)), atol=1e-12)
    np.testing.assert_array_equal(turned["ltibia"], 0)


def test_truth_is_read_at_its_own_rate(tmp_path):
    """The cut is the last frame of its segment, from 1; equal labels are one motion."""
    (tmp_path / "mocap.txt").write_text(
        "86 01\r\nwalk 3 4 5 \r\njump 6 7 8\r\nwalk 9 9 9\r\n\r\n86 02\r\nrun 8 8 8\r\n"
    )
    assert true_motions(tmp_path / "mocap.txt", "86_01").tolist() == [0] * 4 + [1] * 3 + [0] * 2
    assert true_motions(tmp_path / "mocap.txt", "86_02").tolist() == [0] * 8


def test_a_row_says_whether_the_means_agree():
    """Within a standard deviation of theirs, or 0.02."""
    assert row("86_01", ("haca", ""), [0.96, 0.96]).endswith("yes")
    assert row("86_01", ("aca", ""), [0.93, 0.93]).endswith("+0.026")


@pytest.mark.parametrize("name", [("spectral", ""), ("aca", "as measured"), ("haca", "as measured")])
def test_the_authors_figures_come_out(shared, name):
    """One seed on one trial, within two of their standard deviations or 0.02."""
    folder = shared / "data" / "cmu86"
    features = joint_angles((folder / "86_09.amc").read_text())
    truth = true_motions(folder / "mocap.txt", "86_09")
    with threadpool_limits(1):
        blocks = reduce_frames(features, REDUCED_BY, seed=0)
        labels = METHODS[name](frame_kernel(blocks.of(features)), 4, 0)
    mean, deviation = AUTHORS[name[0]][TRIALS.index("86_09")]
    assert frame_accuracy(labels, truth[blocks.bounds[1:] - 1]) == pytest.approx(
        mean, abs=max(2 * (deviation or 0), 0.02)
    )
