"""Models of expressions that are tried at points, without the expressions."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from autograder.protocol import Call


@dataclass(frozen=True)
class AtPoints:
    """Stands for a model whose arguments are SymPy's: `of(call, point)` gives its numbers at a point.

    Nothing is read or differentiated by SymPy, which would take longer than all the rest.
    """

    of: Callable[[Call, Mapping[str, float]], np.ndarray]

    def __call__(self, call: Call) -> np.ndarray:
        """(points, …)."""
        return np.array([self.of(call, point) for point in call.at], dtype=float)
