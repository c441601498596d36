"""Types of the public interface."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

OUTSIDE = "what a type says changes no result"

__all__ = ["ArrayLike", "Floats", "HasMgf", "Integers", "Law"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Law = str | Path | Sequence[float] | Floats  # a name, a file or a table


class HasMgf(Protocol):
    """An initial law by its moment-generating function."""

    def mgf(self, z: Any) -> Any:
        """Return E exp(z v) of one component, for an array of complex z."""
