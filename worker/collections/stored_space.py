"""The pose space of a collection as a blob: learned from its takes once, and the same for all that come later."""

import io
import json
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.core.together.compared_body import ComparedBody
from caesura.core.together.pose_space import PoseSpace


@dataclass(frozen=True)
class StoredSpace:
    """The space, and how far segments are apart in it: `spreads` (3,), as `MotionSignatures.spreads`."""

    space: PoseSpace
    spreads: Float[np.ndarray, "3"]

    def to_bytes(self) -> bytes:
        """As an NPZ of plain arrays."""
        body, out = self.space.body, io.BytesIO()
        described = {"kind": body.kind, "names": body.names, "topology": body.topology, "mirrors": self.space.mirrors}
        np.savez(
            out,
            described=np.frombuffer(json.dumps(described).encode(), np.uint8),
            reference=self.space.reference,
            directions=self.space.directions,
            signs=self.space.signs,
            spreads=self.spreads,
        )
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "StoredSpace":
        """The space that `to_bytes` wrote."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            described = json.loads(stored["described"].tobytes())
            body = ComparedBody(described["kind"], tuple(described["names"]), described["topology"])
            arrays = (stored["reference"], stored["directions"], stored["signs"])
            return cls(PoseSpace(body, *arrays, bool(described["mirrors"])), stored["spreads"])
