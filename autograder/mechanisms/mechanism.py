"""A mechanism: its coordinates, parameters and energies, from which M, C, g and all else follow."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import sympy as sp

from autograder.mechanisms.friction import FrictionTerm, refuse_other_than_friction
from autograder.mechanisms.outline import Coordinate, Outline, Parameter, Part
from autograder.mechanisms.refusals import (
    further_of,
    refuse_bad_drawing,
    refuse_bad_energies,
    refuse_bad_name,
    refuse_bad_names,
    refuse_bad_units_and_ranges,
    refuse_doubles,
    sections_of,
    sentences_of,
    tuple_of,
)
from autograder.mechanisms.shapes import Shape, arm
from autograder.mechanisms.units import refuse_other_than_joules


@dataclass(frozen=True)
class EnergyTerm(Part):
    """A part of an energy, with its formula."""

    energy: sp.Expr


@dataclass(frozen=True)
class Mechanism(Outline):
    """A robot given by its energies.

    kinetic, potential: the named terms whose sums are K (J) and P (J), expressions in the
    coordinates, velocities and parameters of the mechanism. points(q, arm): what is drawn, (x, y) in m
    one after the other; q: (n,), arm: a namespace of the parameters' numbers. friction: named terms
    too; only an answer that asks for them has their coefficients in its arms. draws(q, arm): the shapes
    of the problem's picture (`shapes.py`); without it, links through the points. sentences: a teacher's
    own, each by its mistake, as "M: dropped / the rotation of link 2*": the answer, then the name that
    `autograder try --names` shows, with `*` for anything. further: by answer, what a card says after a
    right one. sections: by answer, the section of a lesson that a card leads to: the lesson's name, the
    id of a cell, and the heading. An answer that they lack has the kit's.

    ValueError, naming what is wrong: for names that are given twice; a coordinate that is no angle (rad)
    or length (m); a range that is empty or not positive; a symbol in an energy that is none of the
    mechanism's; a term of K that is not quadratic in q̇, or one of P that holds q̇; a unit that is not
    known, or a term whose unit is not J; `points` that fail.
    """

    name: str
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    kinetic: tuple[EnergyTerm, ...]
    potential: tuple[EnergyTerm, ...]
    points: Callable[[np.ndarray, SimpleNamespace], Sequence[tuple[float, float]]]
    friction: tuple[FrictionTerm, ...] = ()
    draws: Callable[[np.ndarray, SimpleNamespace], Sequence[Shape]] | None = None
    sentences: Mapping[str, str] | tuple[tuple[str, str], ...] = ()
    further: Mapping[str, str] = field(default_factory=dict)
    sections: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)

    def __post_init__(self):
        where = f"mechanism {self.name!r}"
        object.__setattr__(self, "sentences", sentences_of(where, self.sentences))
        object.__setattr__(self, "further", further_of(where, self.further))
        object.__setattr__(self, "sections", sections_of(where, self.sections))
        refuse_bad_name(where, self.name)
        for parts, kind in _KINDS.items():
            object.__setattr__(self, parts, tuple_of(where, parts, kind, getattr(self, parts)))
        refuse_bad_names(where, self)
        refuse_bad_units_and_ranges(where, self)
        refuse_bad_energies(where, self)
        for friction in self.friction:
            refuse_other_than_friction(where, friction, self)
        coefficients = [term.symbol.name for term in self.friction]
        refuse_doubles(where, "coefficients of friction", coefficients)
        refuse_other_than_joules(where, self)
        refuse_bad_drawing(where, self)

    def shapes(self, q: np.ndarray, given: SimpleNamespace) -> list[Shape]:
        """What the picture of one position is made of."""
        if self.draws is not None:
            return list(self.draws(q, given))
        return arm([(float(x), float(y)) for x, y in self.points(q, given)])

    __hash__ = Outline.__hash__

    @property
    def full(self) -> "Mechanism":
        return self

    @property
    def q(self) -> tuple[sp.Symbol, ...]:
        return tuple(c.symbol for c in self.coordinates)

    @property
    def qd(self) -> tuple[sp.Symbol, ...]:
        return tuple(c.velocity for c in self.coordinates)

    @property
    def K(self) -> sp.Expr:
        return sp.Add(*(term.energy for term in self.kinetic))

    @property
    def P(self) -> sp.Expr:
        return sp.Add(*(term.energy for term in self.potential))

    def drawn(self, rng: np.random.Generator, friction: bool = False) -> SimpleNamespace:
        """Random parameters from their ranges, by their names; with friction also its coefficients, an
        array (n,) of each kind.
        """
        arm = SimpleNamespace(
            **{p.name: float(rng.uniform(p.low, p.high)) for p in self.parameters}
        )
        for term in self.friction if friction else ():
            numbers = vars(arm).setdefault(term.coefficient, np.zeros(self.n))
            numbers[self.place(term)] = rng.uniform(term.low, term.high)
        return arm

    def placed(self, rng: np.random.Generator) -> np.ndarray:
        """A random q, (n,): angles whose sine and cosine do not nearly vanish, lengths up to 1 m."""
        return np.array(
            [_angle(rng) if c.unit == "rad" else _length(rng) for c in self.coordinates]
        )

    def moving(self, rng: np.random.Generator) -> np.ndarray:
        """A random q̇, (n,): either sign, none near zero."""
        return rng.choice([-1.0, 1.0], self.n) * rng.uniform(0.5, 3.0, self.n)


_KINDS = {
    "coordinates": Coordinate,
    "parameters": Parameter,
    "kinetic": EnergyTerm,
    "potential": EnergyTerm,
    "friction": FrictionTerm,
}


def _angle(rng) -> float:
    return float(rng.integers(-2, 2) * np.pi / 2 + rng.uniform(0.2, np.pi / 2 - 0.2))


def _length(rng) -> float:
    return float(rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 1.0))
