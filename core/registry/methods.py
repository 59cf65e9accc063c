"""The methods by name: to add one, write its file and add its line here. Light: no NumPy.

Parameters, the API's schemas, the command's help, the page's menu and the benchmarks read this table.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from caesura.core.analysis import Analysis
    from caesura.core.parameters import Parameters
    from caesura.core.segmentation import Cut


@dataclass(frozen=True)
class Method:
    """One way to cut a take: its name, the place of its function below `core.methods`, and what it does."""

    name: str
    function: str
    description: str
    needs_motions: bool = False
    """Whether it must be given K: such a method has no way of its own to choose it."""
    reads_peak_strain: bool = True
    """Whether it looks at the strain at the peaks of the energy curve, which takes time to measure."""

    def load(self) -> "Callable[[Analysis, Parameters], Cut]":
        """The function, imported at its first use: most methods need scikit-learn, and the default does not."""
        module, _, name = self.function.partition(":")
        found: Callable[[Analysis, Parameters], Cut] = getattr(import_module(f"caesura.core.methods.{module}"), name)
        return found


METHODS = {
    method.name: method
    for method in (
        Method(
            "switching",
            "switching.method:switching",
            "The default: what every frame does is explained by one of K motions, and changing motion costs.",
            reads_peak_strain=False,
        ),
        Method(
            "joint-entropy",
            "joint_entropy.method:joint_entropy",
            "The paper's: key-frames of the joint-entropy curve, grouped by k-means, cuts between groups.",
        ),
        Method(
            "luo2014",
            "luo2014:luo2014",
            "Compared with: segments in which frames differ least on average, then grouped. Up to 10,000 frames.",
            needs_motions=True,
        ),
        Method(
            "spectral",
            "alignment.spectral:spectral",
            "Compared with: spectral clustering of single frames, no run too short. Up to 5,000 frames.",
            needs_motions=True,
        ),
        Method(
            "aca",
            "alignment.aca:aca",
            "Compared with: aligned cluster analysis, groups of segments alike at any speed. Up to 5,000 frames.",
            needs_motions=True,
        ),
        Method(
            "haca",
            "alignment.haca:haca",
            "Compared with: aligned cluster analysis in two levels, moves and motions. Up to 5,000 frames.",
            needs_motions=True,
        ),
        Method(
            "pca",
            "barbic2004.pca:pca",
            "Compared with: cuts where poses leave the hyperplane of those before, then grouped.",
            needs_motions=True,
        ),
        Method(
            "ppca",
            "barbic2004.ppca:ppca",
            "Compared with: cuts where the distribution of poses changes, then grouped.",
            needs_motions=True,
        ),
        Method(
            "gmm",
            "barbic2004.gmm:gmm",
            "Compared with: frames by the Gaussian of a mixture they are likeliest of. Up to 50,000 frames.",
            needs_motions=True,
        ),
        Method(
            "hmm",
            "hidden_markov:hidden_markov",
            "Compared with: a hidden Markov model whose states are windows. Up to 10,000 frames.",
            needs_motions=True,
        ),
        Method(
            "velocity-minima",
            "velocity_minima:velocity_minima",
            "Compared with: cuts where the body all but stops, then grouped.",
            needs_motions=True,
        ),
        Method(
            "genetic",
            "reconstruction.genetic:genetic",
            "Compared with: key-frames of least reconstruction error, bred, then grouped. Up to 20,000 frames.",
            needs_motions=True,
        ),
        Method(
            "curve-simplification",
            "reconstruction.curve_simplification:curve_simplification",
            "Compared with: key-frames where the curve of poses strays most, then grouped. Up to 50,000 frames.",
            needs_motions=True,
        ),
    )
}
