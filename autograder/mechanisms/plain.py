"""What of a mechanism is no formula: names, units, ranges and zeros, of which problems are told.

Nothing here imports SymPy before a symbol is asked for, as a check whose formulas are kept needs none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import sympy as sp


@dataclass(frozen=True)
class Coordinate:
    """A generalised coordinate. zero: where it is 0, in words: "link 1 along the x axis"."""

    name: str
    unit: str
    zero: str

    @property
    def symbol(self) -> sp.Symbol:
        return _sympy().Symbol(self.name, real=True)

    @property
    def velocity(self) -> sp.Symbol:
        """qd1 for q1, xd for x."""
        head = self.name.rstrip("0123456789")
        return _sympy().Symbol(f"{head}d{self.name[len(head) :]}", real=True)


@dataclass(frozen=True)
class Parameter:
    """A parameter: what it is, and the range from which random mechanisms draw it."""

    name: str
    unit: str
    doc: str
    low: float
    high: float

    @property
    def symbol(self) -> sp.Symbol:
        return _sympy().Symbol(self.name, positive=True)


@dataclass(frozen=True)
class Part:
    """A part of an energy, in words: "the rotation of link 2"."""

    name: str


@dataclass(frozen=True)
class Plain:
    """A mechanism without its formulas. points(q, arm): as of a `Mechanism`."""

    name: str
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    kinetic: tuple[Part, ...]
    potential: tuple[Part, ...]
    points: Callable[[np.ndarray, SimpleNamespace], Sequence[tuple[float, float]]]

    @property
    def n(self) -> int:
        return len(self.coordinates)

    def drawn(self, rng: np.random.Generator) -> SimpleNamespace:
        """Random parameters from their ranges, by their names."""
        return SimpleNamespace(
            **{p.name: float(rng.uniform(p.low, p.high)) for p in self.parameters}
        )

    def placed(self, rng: np.random.Generator) -> np.ndarray:
        """A random q, (n,): angles whose sine and cosine do not nearly vanish, lengths up to 1 m."""
        return np.array(
            [_angle(rng) if c.unit == "rad" else _length(rng) for c in self.coordinates]
        )

    def moving(self, rng: np.random.Generator) -> np.ndarray:
        """A random q̇, (n,): either sign, none near zero."""
        return rng.choice([-1.0, 1.0], self.n) * rng.uniform(0.5, 3.0, self.n)


def _angle(rng) -> float:
    return float(rng.integers(-2, 2) * np.pi / 2 + rng.uniform(0.2, np.pi / 2 - 0.2))


def _length(rng) -> float:
    return float(rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 1.0))


def _sympy():
    import sympy

    return sympy
