"""A mechanism: its coordinates, parameters and energies, from which M, C, g and all else follow."""

import keyword
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import sympy as sp

from autograder.mechanisms.friction import FrictionTerm, refuse_other_than_friction
from autograder.mechanisms.outline import Coordinate, Outline, Parameter, Part
from autograder.mechanisms.shapes import SHAPES, Shape, arm
from autograder.mechanisms.units import refuse_other_than_joules

UNITS_OF_COORDINATES = ("rad", "m")


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
    `autograder try --names` shows, with `*` for anything.

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

    def __post_init__(self):
        where = f"mechanism {self.name!r}"
        object.__setattr__(self, "sentences", _pairs(where, self.sentences))
        if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", str(self.name)):
            raise ValueError(
                f"{where}: needs a name of small letters, digits and hyphens, as cart-pole"
            )
        for field, kind in _KINDS.items():
            given = getattr(self, field)
            if not isinstance(given, Sequence) or not all(isinstance(e, kind) for e in given):
                raise ValueError(
                    f"{where}: {field} needs a tuple of {kind.__name__}, as ({kind.__name__}(…),); "
                    f"it is {given!r}"
                )
            object.__setattr__(self, field, tuple(given))
        for entry in [*self.coordinates, *self.parameters]:
            name = str(getattr(entry, "name", ""))
            if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name) or keyword.iskeyword(name):
                raise ValueError(
                    f"{where}: the name {name!r} needs letters and digits alone, and to be no word of "
                    "Python's"
                )
        names = [c.name for c in self.coordinates] + [p.name for p in self.parameters]
        names += [c.velocity.name for c in self.coordinates]
        _once(where, "symbols", names)
        terms = [term.name for term in (*self.kinetic, *self.potential)]
        _once(where, "energy terms", terms)
        _once(where, "terms", [*terms, *(term.name for term in self.friction)])
        for coordinate in self.coordinates:
            if coordinate.unit not in UNITS_OF_COORDINATES:
                raise ValueError(
                    f"{where}: {coordinate.name} has the unit {coordinate.unit!r}, needs rad or m"
                )
            if coordinate.name == "q" and len(self.coordinates) > 1:
                raise ValueError(
                    f"{where}: 'q' is the vector of all its coordinates; give this one another name"
                )
        for p in self.parameters:
            if not p.unit or not isinstance(p.unit, str):
                raise ValueError(f"{where}: {p.name} needs a unit, as kg")
            if (
                not all(isinstance(x, int | float) for x in (p.low, p.high))
                or not 0 < p.low < p.high
            ):
                raise ValueError(
                    f"{where}: {p.name} is drawn from {p.low} to {p.high}; needs 0 < low < high"
                )
        for term in self.kinetic:
            self._refuse_foreign(where, "K", term)
            self._refuse_other_than_quadratic(where, term)
        for term in self.potential:
            self._refuse_foreign(where, "P", term)
            held = sorted(s.name for s in sp.sympify(term.energy).free_symbols & set(self.qd))
            if held:
                raise ValueError(
                    f"{where}: {term.name!r} of P holds {', '.join(held)}, a velocity; P is a "
                    "function of the coordinates alone"
                )
        for friction in self.friction:
            refuse_other_than_friction(where, friction, self)
        _once(where, "coefficients of friction", [term.symbol.name for term in self.friction])
        refuse_other_than_joules(where, self)
        self._try_points(where)

    def _refuse_foreign(self, where: str, energy: str, term: EnergyTerm) -> None:
        try:
            symbols = sp.sympify(term.energy).free_symbols
        except (sp.SympifyError, TypeError, AttributeError) as error:
            raise ValueError(
                f"{where}: {term.name!r} of {energy} is no expression ({error}); it is made of "
                "m.symbol, x.symbol and x.velocity"
            ) from None
        known = {*self.q, *self.qd, *(p.symbol for p in self.parameters)}
        unknown = sorted(s.name for s in symbols - known)
        if unknown:
            raise ValueError(
                f"{where}: {term.name!r} holds {', '.join(unknown)}, which is neither a "
                "coordinate, nor a velocity, nor a parameter of the mechanism"
            )

    def _refuse_other_than_quadratic(self, where: str, term: EnergyTerm) -> None:
        """Tried in numbers, as that is quick: twice the velocities give four times the energy."""
        rng = np.random.default_rng(0)
        at = {s: rng.uniform(0.5, 1.0) for s in sp.sympify(term.energy).free_symbols}

        def energy(factor):
            faster = {s: factor * x if s in self.qd else x for s, x in at.items()}
            return complex(sp.sympify(term.energy).xreplace(faster).evalf())

        once = energy(1.0)
        if not np.allclose(
            [energy(2.0), energy(-3.0)], [4 * once, 9 * once], rtol=1e-9, atol=1e-12
        ):
            raise ValueError(f"{where}: {term.name!r} of K is not quadratic in the velocities")

    def _try_points(self, where: str) -> None:
        rng = np.random.default_rng(0)
        try:
            points = np.array(self.points(self.placed(rng), self.drawn(rng)), dtype=float)
        except Exception as error:  # whatever the author's function raises
            raise ValueError(f"{where}: points raised {type(error).__name__}: {error}") from error
        if points.ndim != 2 or points.shape[1] != 2:
            raise ValueError(
                f"{where}: points gave {points.shape}, needs one (x, y) for each point"
            )

        if self.draws is None:
            return
        try:
            drawn = list(self.draws(self.placed(rng), self.drawn(rng)))
        except Exception as error:
            raise ValueError(f"{where}: draws raised {type(error).__name__}: {error}") from error
        if not drawn or not all(isinstance(shape, SHAPES) for shape in drawn):
            kinds = ", ".join(kind.__name__ for kind in SHAPES)
            raise ValueError(f"{where}: draws gave {drawn}, needs a list of {kinds}")

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


def _pairs(where: str, sentences: object) -> tuple[tuple[str, str], ...]:
    """A teacher's sentences as pairs, so that a mechanism stays hashable."""
    given = list(sentences.items()) if isinstance(sentences, Mapping) else sentences
    if not isinstance(given, list | tuple) or not all(
        isinstance(pair, tuple) and len(pair) == 2 and all(isinstance(text, str) for text in pair)
        for pair in given
    ):
        raise ValueError(
            f"{where}: sentences needs a dict of texts, as "
            f'{{"M: dropped / the spring": "What else …?"}}; it is {sentences!r}'
        )
    for mistake, _ in given:
        if ": " not in mistake:
            raise ValueError(
                f'{where}: the sentence for {mistake!r} does not say of which answer; write "M: '
                f"{mistake}\" or another answer's name"
            )
    return tuple(given)


def _once(where: str, kind: str, names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{where}: two of its {kind} are {name!r}")


def _angle(rng) -> float:
    return float(rng.integers(-2, 2) * np.pi / 2 + rng.uniform(0.2, np.pi / 2 - 0.2))


def _length(rng) -> float:
    return float(rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 1.0))
