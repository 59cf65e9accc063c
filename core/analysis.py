"""The analysis: everything that is computed once from the vertices. Each cut of it is fast."""

import io
import json
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Float, Int

from caesura.core.segmentation_document import Notice, Source

Derived = TypeVar("Derived")


@dataclass(frozen=True)
class Features:
    """One descriptor of every frame, projected to its leading components.

    `values` (frames, components), float32, columns ordered by variance and not rescaled, so that distances
    between rows are those of the descriptor. `energy_share` is the share of the descriptor's variance they keep.
    """

    name: str
    values: Float[np.ndarray, "frames components"]
    energy_share: float


@dataclass(frozen=True)
class Analysis:
    """Energy curve, candidate key-frames and frame features of one take.

    `energy` (frames,), nats, NaN where the windows do not fit. `peaks` are all local maxima of the curve (the
    first of equal neighbours), whatever ω is; `peak_strain` (peaks, T') is the normalised strain there, on the
    triangles themselves or, above the memory budget, on area-weighted patches. `strain_scale` is the strain
    that counts as 1. `peak_triangles` are the animation's triangles that the columns of `peak_strain` are of,
    none where they are patches or pairs of points. `heavy` are the parameters it was made with. `threads` may be used
    to cut it: of this process, and not stored.
    """

    frames: int
    frame_rate: float
    source: Source
    heavy: dict[str, Any]
    energy: Float[np.ndarray, "frames"]
    peaks: Int[np.ndarray, "peaks"]
    peak_strain: Float[np.ndarray, "peaks patches"]
    features: tuple[Features, ...]
    strain_scale: float
    notices: tuple[Notice, ...] = ()
    peak_triangles: Int[np.ndarray, "columns"] = field(default_factory=lambda: np.zeros(0, np.int64))
    threads: int = field(default=1, repr=False, compare=False)
    _derived_values: dict[Any, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def to_bytes(self) -> bytes:
        """As an NPZ: plain arrays and one JSON member, nothing pickled."""
        arrays: dict[str, Any] = {"energy": self.energy, "peaks": self.peaks, "peak_strain": self.peak_strain}
        arrays["peak_triangles"] = self.peak_triangles
        arrays |= {f"features_{i}": f.values for i, f in enumerate(self.features)}
        meta = {
            "frames": self.frames,
            "frame_rate": self.frame_rate,
            "source": self.source.model_dump(),
            "heavy": self.heavy,
            "features": [[f.name, f.energy_share] for f in self.features],
            "strain_scale": self.strain_scale,
            "notices": [n.model_dump() for n in self.notices],
        }
        arrays["meta"] = np.frombuffer(json.dumps(meta).encode(), np.uint8)
        out = io.BytesIO()
        np.savez(out, **arrays)
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "Analysis":
        """The analysis that `to_bytes` wrote."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            meta = json.loads(stored["meta"].tobytes())
            features = tuple(
                Features(name, stored[f"features_{i}"], share) for i, (name, share) in enumerate(meta["features"])
            )
            return cls(
                frames=meta["frames"],
                frame_rate=meta["frame_rate"],
                source=Source(**meta["source"]),
                heavy=meta["heavy"],
                energy=stored["energy"],
                peaks=stored["peaks"],
                peak_strain=stored["peak_strain"],
                features=features,
                strain_scale=meta["strain_scale"],
                notices=tuple(Notice(**n) for n in meta["notices"]),
                peak_triangles=stored["peak_triangles"],
            )

    def derived(self, make: "Callable[[Analysis], Derived]") -> Derived:
        """`make(self)`, made at the first call and kept: what cuts of one analysis have in common."""
        if make not in self._derived_values:
            self._derived_values[make] = make(self)
        made: Derived = self._derived_values[make]
        return made

    def with_notices(self, *notices: Notice) -> "Analysis":
        """The same analysis, saying more."""
        return replace(self, notices=self.notices + notices)
