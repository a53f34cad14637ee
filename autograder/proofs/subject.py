"""What lines are about: names with their shapes, and the reasons that tie them together.

A reason is a fact that may be given or not. Where none is given, every name stands for numbers of its
own. Where "symmetry of M" is given, M is drawn symmetric; where a definition is given, the name stands
for its definition. So a step follows from its reasons if and only if its two sides agree in all worlds
where these are given and no other: to assume a fact and to break it are the same test with another set.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from autograder.proofs.calculus import Calculus
from autograder.proofs.evaluating import Value, value_of
from autograder.proofs.expression import Node
from autograder.proofs.parsing import Parser

WORLDS = 24  # drawn at once; half of them at the edge of what is given (see `inertia.py`)


@dataclass(frozen=True)
class Reason:
    """A fact that a step may rest on.

    name: as it is typed. says: the fact in words. kind: what is told of it where a student has missed
    it: "a definition". defines: names, or names of rates, with the text of their definitions. rules:
    the variables by which derivatives may be taken. What is neither is a property: `draw` sees its name.
    """

    name: str
    says: str
    kind: str
    defines: tuple[tuple[str, str], ...] = ()
    rules: tuple[str, ...] = ()


@dataclass(frozen=True)
class Subject:
    """meanings: name → what it is, as the card lists it. rates: name → the name of its rate. drawn: the
    names that have numbers; rates of other names are Unknown. draw(rng, given): (WORLDS, rows,
    columns) for each of them, given: names of reasons and mistakes. truth: the names of properties and
    rules that hold in reality; true_definitions: all of them without contradiction.
    short: names that only stand for an expression.
    """

    meanings: Mapping[str, str]
    rates: Mapping[str, str]
    constants: Mapping[str, frozenset[str]]
    variables: frozenset[str]
    reasons: tuple[Reason, ...]
    draw: Callable[[np.random.Generator, frozenset[str]], dict[str, np.ndarray]]
    truth: frozenset[str]
    true_definitions: tuple[tuple[str, str], ...]
    short: Mapping[str, str] = field(default_factory=dict)
    parser: Parser = field(init=False, repr=False, compare=False)

    def __post_init__(self):
        # A rate is read as the derivative that it is, but for one that partial derivatives hold still.
        backwards = {r: name for name, r in self.rates.items() if r not in self.variables}
        names = [name for name in self.meanings if name not in {*backwards, *self.short}]
        parser = Parser(names, backwards, self.variables, self.short)
        object.__setattr__(self, "parser", parser)

    def reason(self, name: str) -> Reason | None:
        return next((reason for reason in self.reasons if reason.name == name), None)

    @property
    def everything(self) -> Reason:
        """All that is true, as one reason."""
        return Reason("everything", "", "", self.true_definitions, ("t", *self.variables))


class World:
    """Numbers for all names where some reasons are given: WORLDS times, drawn at random."""

    def __init__(
        self, subject: Subject, rng: np.random.Generator, given: tuple[Reason, ...], more=()
    ):
        """more: names of properties that also hold."""
        self.work = 0  # nodes that were valued
        self._rng = rng
        self._numbers = subject.draw(rng, frozenset([*(reason.name for reason in given), *more]))
        defined = {name: text for reason in given for name, text in reason.defines}
        self._calculus = Calculus(
            {name: subject.parser.read(text) for name, text in defined.items()},
            {of: rate for of, rate in subject.rates.items() if rate in self._numbers},
            subject.constants,
            frozenset(rule for reason in given for rule in reason.rules),
        )
        self._values: dict[int, tuple[Node, Value]] = {}  # the nodes too, so that no id comes again
        self._linear: dict[tuple[str, int], np.ndarray] = {}

    def value(self, node: Node) -> Value:
        """LineError where it has none, or where its derivatives are too long."""
        if id(node) not in self._values:
            try:
                written = self._calculus.written_out(node)
            finally:
                self.work += self._calculus.length
            self._values[id(node)] = node, value_of(written, self._numbers, self._unknown)
        return self._values[id(node)][1]

    def _unknown(self, x: np.ndarray, by: str) -> np.ndarray:
        """A linear function of x that goes with transposes, as derivatives do, and is none."""
        left, right = (self._map(by, size) for size in x.shape[1:])
        return self._map(by, 0) * (left @ x @ np.swapaxes(right, 1, 2))

    def _map(self, by: str, size: int) -> np.ndarray:
        key = (by, size)
        if key not in self._linear:
            shape = (WORLDS, max(size, 1), max(size, 1))
            self._linear[key] = self._rng.normal(size=shape)
        return self._linear[key]
