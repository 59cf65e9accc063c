"""The methods, by name: each cuts a take by what was computed once from its vertices.

The module of a method has its name, and so has the function in it. It is imported at its first use: most methods need
scikit-learn, which takes a second to load, and the default does not.
"""

from collections.abc import Callable
from importlib import import_module

from caesura.core.analysis import Analysis
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

METHODS = ("switching", "joint-entropy", "luo2014", "spectral", "aca", "haca")


def find_method(name: str) -> Callable[[Analysis, Parameters], Cut]:
    """The function of one of `METHODS`."""
    name = name.replace("-", "_")
    found: Callable[[Analysis, Parameters], Cut] = getattr(import_module(f"caesura.core.methods.{name}"), name)
    return found
