"""What of a mechanism is no formula: names, units, ranges, and where a coordinate is zero.

Numbers that are kept are computed with it, without SymPy, which takes a second to import and derive.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from autograder.mechanisms.units import UnitError, spelled

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms.mechanism import Mechanism


@dataclass(frozen=True)
class Coordinate:
    """A generalised coordinate. zero: where it is 0, in words: "link 1 along the x axis"."""

    name: str
    unit: str
    zero: str

    @property
    def symbol(self) -> sp.Symbol:
        import sympy as sp

        return sp.Symbol(self.name, real=True)

    @property
    def velocity(self) -> sp.Symbol:
        import sympy as sp

        return sp.Symbol(self.rate, real=True)

    @property
    def rate(self) -> str:
        """The name of its velocity: qd1 for q1, xd for x."""
        head = self.name.rstrip("0123456789")
        return f"{head}d{self.name[len(head) :]}"


@dataclass(frozen=True)
class Parameter:
    """A parameter: what it is, and the range from which random mechanisms draw it.

    to_find: whether a regressor finds it from measured torques, as a mass, or it is known without them,
    as the length of a link; by default lengths and gravity are known. unit: in any usual spelling; it
    is kept as students read it, m/s² for "m/s^2".
    """

    name: str
    unit: str
    doc: str
    low: float
    high: float
    to_find: bool | None = None

    def __post_init__(self):
        with suppress(UnitError, AttributeError):  # the mechanism says which one cannot be read
            object.__setattr__(self, "unit", spelled(self.unit))

    @property
    def known(self) -> bool:
        return self.unit in ("m", "m/s²") if self.to_find is None else not self.to_find

    @property
    def symbol(self) -> sp.Symbol:
        import sympy as sp

        return sp.Symbol(self.name, positive=True)


@dataclass(frozen=True)
class Part:
    """A part of an energy, in words: "the rotation of link 2"."""

    name: str


@dataclass(frozen=True)
class Resistance:
    """A friction torque or force, in words: "the viscous friction of joint 1".

    coordinate: the name of the one that it resists. coefficient: of the array of arm that holds its
    number, "viscous" for arm.viscous.
    """

    name: str
    coordinate: str
    coefficient: str


class Outline:
    """A mechanism, of which formulas may be asked for in `full` alone."""

    name: str
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    kinetic: tuple[Part, ...]
    potential: tuple[Part, ...]
    friction: tuple[Resistance, ...]
    sentences: Mapping[str, str] | tuple[tuple[str, str], ...]

    # Whether it follows from its name, as those that come with the kit do.
    is_built_in = False

    @property
    def full(self) -> Mechanism:
        """The mechanism with its formulas."""
        raise NotImplementedError

    @property
    def n(self) -> int:
        return len(self.coordinates)

    def place(self, term: Resistance) -> int:
        """The place of the coordinate that a friction term resists."""
        return [c.name for c in self.coordinates].index(term.coordinate)

    @cached_property
    def _hash(self) -> int:
        return hash((self.name, self.coordinates, self.parameters, self.kinetic, self.potential))

    def __hash__(self) -> int:
        """Made once, as what follows from a mechanism is looked up by it."""
        return self._hash


@dataclass(frozen=True)
class BuiltIn(Outline):
    """The outline of a mechanism that comes with the kit."""

    name: str
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    kinetic: tuple[Part, ...]
    potential: tuple[Part, ...]
    friction: tuple[Resistance, ...]
    sentences: tuple[tuple[str, str], ...]

    is_built_in = True
    __hash__ = Outline.__hash__

    @property
    def full(self) -> Mechanism:
        from autograder.mechanisms.built_in import named

        return named(self.name)

    @classmethod
    def of(cls, whole: Mechanism) -> BuiltIn:
        return cls(
            whole.name,
            whole.coordinates,
            whole.parameters,
            tuple(Part(term.name) for term in whole.kinetic),
            tuple(Part(term.name) for term in whole.potential),
            tuple(Resistance(t.name, t.coordinate, t.coefficient) for t in whole.friction),
            tuple(dict(whole.sentences).items()),
        )

    def as_data(self) -> dict:
        """What `from_data` takes, of texts and numbers alone."""
        return {
            "name": self.name,
            "coordinates": [[c.name, c.unit, c.zero] for c in self.coordinates],
            "parameters": [
                [p.name, p.unit, p.doc, p.low, p.high, p.to_find] for p in self.parameters
            ],
            "kinetic": [term.name for term in self.kinetic],
            "potential": [term.name for term in self.potential],
            "friction": [[t.name, t.coordinate, t.coefficient] for t in self.friction],
            "sentences": [list(pair) for pair in self.sentences],
        }

    @classmethod
    def from_data(cls, data: dict) -> BuiltIn:
        return cls(
            data["name"],
            tuple(Coordinate(*fields) for fields in data["coordinates"]),
            tuple(Parameter(*fields) for fields in data["parameters"]),
            tuple(Part(name) for name in data["kinetic"]),
            tuple(Part(name) for name in data["potential"]),
            tuple(Resistance(*fields) for fields in data["friction"]),
            tuple((mistake, sentence) for mistake, sentence in data["sentences"]),
        )
