"""Numbers that glTF can hold: finite ones, also as float32."""

import numpy as np
from jaxtyping import Float

from caesura.core.errors import InvalidModel


def finite_float32(values: Float[np.ndarray, "..."], what: str) -> Float[np.ndarray, "..."]:
    """The values as float32; raises `non-finite-data` saying of `what` they are."""
    with np.errstate(over="ignore", invalid="ignore"):
        found = np.asarray(values).astype(np.float32)
    if not np.isfinite(found).all():
        raise InvalidModel("non-finite-data", f"{what} has a number that is not finite.")
    return found
