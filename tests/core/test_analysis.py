"""An analysis as bytes: what lies between the heavy work and every cut."""

import numpy as np

from caesura.core.analysis import Analysis, Features
from caesura.core.document import Notice, Source


def test_an_analysis_comes_back_from_its_bytes():
    """Arrays bit for bit, NaN included, and everything it says."""
    made = Analysis(
        frames=3,
        frame_rate=29.97,
        source=Source(take=1, name="größe", fps=29.97, start_seconds=0.5),
        heavy={"take": "longest", "bins": 10},
        energy=np.array([np.nan, 0.5, np.nan]),
        peaks=np.array([1]),
        peak_strain=np.float32([[0.1, 0.9]]),
        features=(Features("strain", np.zeros((3, 0), np.float32), 1.0),),
        strain_scale=0.25,
    ).with_notices(Notice(code="frame-rate-assumed", detail="30 it is."))
    again = Analysis.from_bytes(made.to_bytes())
    for name in ("energy", "peaks", "peak_strain"):
        np.testing.assert_array_equal(getattr(again, name), getattr(made, name))
    for name in ("frames", "frame_rate", "source", "heavy", "strain_scale", "notices"):
        assert getattr(again, name) == getattr(made, name)
    assert again.features[0].name == "strain"
    assert again.features[0].values.shape == (3, 0)
    assert again.to_bytes() == made.to_bytes()
