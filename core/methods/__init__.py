"""The methods, by name: each cuts a take by what was computed once from its vertices."""

from collections.abc import Callable

from core.analysis import Analysis
from core.methods.joint_entropy import joint_entropy
from core.methods.switching import switching
from core.parameters import Parameters
from core.segmentation import Cut

METHODS: dict[str, Callable[[Analysis, Parameters], Cut]] = {"switching": switching, "joint-entropy": joint_entropy}
