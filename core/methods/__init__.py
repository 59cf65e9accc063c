"""The methods, by name: each cuts a take by what was computed once from its vertices."""

from collections.abc import Callable

from core.analysis import Analysis
from core.methods.aca import aca
from core.methods.haca import haca
from core.methods.joint_entropy import joint_entropy
from core.methods.luo2014 import luo2014
from core.methods.spectral import spectral
from core.methods.switching import switching
from core.parameters import Parameters
from core.segmentation import Cut

METHODS: dict[str, Callable[[Analysis, Parameters], Cut]] = {
    "switching": switching,
    "joint-entropy": joint_entropy,
    "luo2014": luo2014,
    "spectral": spectral,
    "aca": aca,
    "haca": haca,
}
