"""Formulas as data: which operations to do in which order, for all cases at once.

A tape is kept on disk and read again without SymPy. It holds numbers alone and names only operations
of the tables below, so nothing that is read from a file can run as a program.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np


def _sign(x: np.ndarray, out: np.ndarray) -> None:
    np.sign(x.real, out=out)


def _absolute(x: np.ndarray, out: np.ndarray) -> None:
    """|x|, and of a complex step from x one in its direction: the size of x would have no slope."""
    np.multiply(x, np.sign(x.real), out=out)


UNARY: dict[str, Callable] = {
    "negative": np.negative,
    "reciprocal": np.reciprocal,
    "square": np.square,
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "arcsin": np.arcsin,
    "arccos": np.arccos,
    "arctan": np.arctan,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "exp": np.exp,
    "log": np.log,
    "sign": _sign,
    "absolute": _absolute,
}
BINARY: dict[str, Callable] = {
    "add": np.add,
    "multiply": np.multiply,
    "power": np.power,
    "arctan2": np.arctan2,
    "maximum": np.maximum,
    "minimum": np.minimum,
    "heaviside": np.heaviside,
}


@dataclass(frozen=True)
class Step:
    """One operation on many pairs of numbers, by their places; right is empty where it takes one."""

    operation: str
    left: np.ndarray
    right: np.ndarray


class Tape:
    """inputs: how many numbers go in. Then come the constants, then what each step gives, one after
    the other; outputs: the places of what comes out.

    ValueError for an operation that is not known, or a place that is not there yet.
    """

    def __init__(
        self,
        inputs: int,
        constants: Sequence[float],
        steps: Sequence[tuple[str, Sequence[int], Sequence[int]]],
        outputs: Sequence[int],
    ):
        self.inputs, self.constants = int(inputs), np.array(constants, dtype=float)
        self.steps = [Step(name, _places(left), _places(right)) for name, left, right in steps]
        self.outputs = _places(outputs)
        self.size = self.inputs + len(self.constants)
        for step in self.steps:
            known = BINARY if len(step.right) else UNARY
            if step.operation not in known or len(step.right) not in (0, len(step.left)):
                raise ValueError(f"a tape has the operation {step.operation!r}, which is not known")
            self._refuse_outside(step.left)
            self._refuse_outside(step.right)
            self.size += len(step.left)
        self._refuse_outside(self.outputs)

    def _refuse_outside(self, places: np.ndarray) -> None:
        if len(places) and not 0 <= places.min() <= places.max() < self.size:
            raise ValueError(f"a tape reads a place outside its {self.size}")

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        """(inputs, cases) → (outputs, cases); complex where the inputs are."""
        found = np.empty((self.size, np.shape(columns)[1]), np.result_type(columns, float))
        found[: self.inputs] = columns
        at = self.inputs + len(self.constants)
        found[self.inputs : at] = self.constants[:, np.newaxis]
        for step in self.steps:
            out = found[at : at + len(step.left)]
            if len(step.right):
                BINARY[step.operation](found[step.left], found[step.right], out=out)
            else:
                UNARY[step.operation](found[step.left], out=out)
            at += len(step.left)
        return found[self.outputs]

    def as_data(self) -> dict:
        """What `from_data` takes, of numbers and names alone."""
        steps = [[s.operation, s.left.tolist(), s.right.tolist()] for s in self.steps]
        return {
            "inputs": self.inputs,
            "constants": self.constants.tolist(),
            "steps": steps,
            "outputs": self.outputs.tolist(),
        }

    @classmethod
    def from_data(cls, data: dict) -> "Tape":
        return cls(data["inputs"], data["constants"], data["steps"], data["outputs"])


def _places(places: Sequence[int]) -> np.ndarray:
    return np.array(places, dtype=np.intp)
