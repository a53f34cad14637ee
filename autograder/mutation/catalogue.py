"""All mistakes of one answer for one mechanism: wrong terms, wrong entries, wrong steps.

The numbers of all of them come from one compiled function, as each is the right answer plus what a
rewritten term contributes, less what the right one does.
"""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from functools import cached_property
from types import SimpleNamespace

import numpy as np
import sympy as sp

from autograder.mechanisms import EnergyTerm, Mechanism
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS, coriolis, gradient, inertia
from autograder.mutation.operators import rewritings
from autograder.mutation.steps import STEPS, Right
from autograder.mutation.tape import Tape
from autograder.mutation.taping import taped

# To less than this share of the answer two mistakes give the same numbers.
SAME = 1e-7
CASES = 8
# Steps that leave some entries as they are: these others may show another mistake.
OF_SOME_ENTRIES = ("diagonal alone", "upper triangle alone")
# Of one entry, what is done to a term of it; the other operators change all entries alike.
OF_AN_ENTRY = ("dropped", "wrong sign", "doubled", "halved")


@dataclass(frozen=True)
class Mutant:
    """A mistake: what was done to which term, in which entry ("" for all) or on which step.

    in_energy: whether it was done to the energy, from which the answer was then derived.
    """

    operator: str
    term: str = ""
    entry: str = ""
    put: str = ""
    instead_of: str = ""
    in_energy: bool = False

    @property
    def is_of_whole(self) -> bool:
        """Whether it was done to the answer as a whole, so that no entry shows it by itself."""
        steps = {name for steps in STEPS.values() for name in steps}
        return self.operator in steps - set(OF_SOME_ENTRIES)


class Catalogue:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Mechanism, answer: str):
        self.mechanism, self.answer = mechanism, ANSWERS[answer]
        definition = (sp.srepr(_plain(mechanism)), answer)
        self._kept, self._of_term, self._tape, self._tape_of_whole = kept.entry(
            ("catalogue", *definition), self._made, self._read
        )

    def _made(self) -> dict:
        """All mistakes, as plain data."""
        self._wrong = list(self._rewritten())
        own = [e for entries in self._contributed for e in entries]
        wrong = [e for _, _, contributed, _ in self._wrong for e in contributed]
        self._of_term = np.array([k for k, *_ in self._wrong], dtype=int)
        self._tape = taped(self._symbols, [*own, *wrong])
        self._tape_of_whole = taped(self._symbols, self._of_whole())
        every = self._all()
        drawn = self._drawn(np.random.default_rng(0))
        with np.errstate(all="ignore"):
            numbers = self._numbers_of(every, *drawn)
        right = self.right(*drawn)
        if not self.answer.shape(self.mechanism.n):  # of an energy only its changes count
            numbers, right = numbers[:, ::2] - numbers[:, 1::2], right[::2] - right[1::2]
        return {
            "mutants": [
                [astuple(mutant), of if isinstance(of, str) else [of[0], _listed(of[1])]]
                for mutant, of in _each_once(every, numbers, right)
            ],
            "of_term": self._of_term.tolist(),
            "tape": self._tape.as_data(),
            "whole": self._tape_of_whole.as_data(),
        }

    def _read(self, data: dict) -> tuple:
        of_term = np.array(data["of_term"], dtype=int)
        found = []
        for fields, of in data["mutants"]:
            if isinstance(of, str):
                STEPS[self.answer.name][of]  # KeyError where there is none
            else:
                of_term[of[0]]
                of = (of[0], None if of[1] is None else np.array(of[1], dtype=float))
            found.append((Mutant(*fields), of))
        tape, whole = Tape.from_data(data["tape"]), Tape.from_data(data["whole"])
        entries = int(np.prod(self.answer.shape(self.mechanism.n)))
        if len(tape.outputs) != (len(self.terms) + len(of_term)) * entries:
            raise ValueError("the tape is not that of these mistakes")
        return found, of_term, tape, whole

    def _rewritten(self):
        """(term, rewriting, what it contributes, whether it was made in the energy).

        What was done to a term of the answer itself is the simpler reading, so it comes first.
        """
        derived = self.answer.of_kinetic or self.answer.of_potential
        assert derived is not None
        m = self.mechanism
        for k, term in enumerate(self.terms):
            for rewriting in rewritings(sp.Tuple(*derived(term.energy, m)), m):
                yield k, rewriting, list(rewriting.expressions), False
        for k, term in enumerate(self.terms):
            for rewriting in rewritings(sp.Tuple(term.energy), m):
                yield k, rewriting, derived(rewriting.expressions[0], m), True

    @property
    def terms(self) -> tuple[EnergyTerm, ...]:
        """The terms of the energy that the answer follows from."""
        of_K = self.answer.of_kinetic is not None
        return self.mechanism.kinetic if of_K else self.mechanism.potential

    @property
    def mutants(self) -> list[Mutant]:
        return [mutant for mutant, _ in self._kept]

    def numbers(self, q, qd, arms: Sequence[SimpleNamespace]) -> np.ndarray:
        """What each mutant returns: (mutants, cases, …). q, qd: (cases, n); arms: one a case."""
        with np.errstate(all="ignore"):  # a wrong term may have no value everywhere
            return self._numbers_of(self._kept, q, qd, arms)

    def right(self, q, qd, arms) -> np.ndarray:
        """The right answer, (cases, …)."""
        return np.sum(self.contributions(q, qd, arms), axis=0)

    def contributions(self, q, qd, arms) -> np.ndarray:
        """What each right term contributes to the answer, (terms, cases, …)."""
        with np.errstate(all="ignore"):  # wrong terms come with them
            return self._contributions(q, qd, arms)[0]

    def _all(self) -> list[tuple[Mutant, object]]:
        """Each mistake with what its numbers are made of: a step's name, or (rewriting, entry)."""
        plain: list = [(Mutant(name), name) for name in STEPS[self.answer.name]]
        others: list = []
        alike: dict[tuple, list[int]] = {}
        entries = []
        for r, (k, done, _, in_energy) in enumerate(self._wrong):
            name = self.terms[k].name
            mutant = Mutant(done.operator, name, "", done.put, done.instead_of, in_energy)
            (plain if done.operator in OF_AN_ENTRY else others).append((mutant, ([r], None)))
            if done.operator in OF_AN_ENTRY:
                for entry, mask in self._entries():
                    entries.append((Mutant(done.operator, name, entry), ([r], mask)))
            else:
                alike.setdefault((done.operator, done.put, done.instead_of, in_energy), []).append(
                    r
                )
        for (operator, put, instead_of, in_energy), all_of_them in alike.items():
            if len({self._wrong[r][0] for r in all_of_them}) > 1:
                mutant = Mutant(operator, "", "", put, instead_of, in_energy)
                others.append((mutant, (all_of_them, None)))
        return plain + entries + others

    def _entries(self) -> list[tuple[str, np.ndarray]]:
        """The entries by name, with where they are; M12 stands for M21 too."""
        n, shape = self.mechanism.n, self.answer.shape(self.mechanism.n)
        found = []
        for at in np.ndindex(shape):
            if self.answer.name == "M" and at[0] > at[-1]:
                continue
            mask = np.zeros(shape)
            mask[at] = 1
            if self.answer.name == "M":
                mask[at[::-1]] = 1
            head = self.answer.name.removesuffix("_vec")
            found.append((head + "".join(str(i + 1) for i in at), mask))
        return found if n > 1 and shape else []

    def _drawn(self, rng):
        m = self.mechanism
        arms = [arm for _ in range(CASES) for arm in 2 * [m.drawn(rng)]]  # each in two places
        size = len(arms)
        q = np.array([m.placed(rng) for _ in range(size)])
        qd = np.array([m.moving(rng) for _ in range(size)])
        return q, qd, arms

    def _numbers_of(self, chosen, q, qd, arms) -> np.ndarray:
        own, rewritten = self._contributions(q, qd, arms)
        right = np.sum(own, axis=0)
        found = np.empty((len(chosen), *right.shape))
        whole = self._whole(q, qd, arms)
        for i, (_, of) in enumerate(chosen):
            if isinstance(of, str):
                found[i] = STEPS[self.answer.name][of](whole)
            else:
                which, mask = of
                change = sum(rewritten[r] - own[self._of_term[r]] for r in which)
                found[i] = right + (change if mask is None else mask * change)
        return found

    def _contributions(self, q, qd, arms) -> tuple[np.ndarray, np.ndarray]:
        """Of the right terms, and of the rewritten ones: (…, cases, *shape) each."""
        numbers = self._shaped(q, qd, arms)
        return numbers[: len(self.terms)], numbers[len(self.terms) :]

    def _shaped(self, q, qd, arms) -> np.ndarray:
        flat = self._tape(np.array(self._columns(q, qd, arms)))
        return np.moveaxis(flat.reshape(-1, *self.answer.shape(self.mechanism.n), len(q)), -1, 1)

    def _whole(self, q, qd, arms) -> Right:
        n = self.mechanism.n
        flat = self._tape_of_whole(np.array(self._columns(q, qd, arms))).T
        sizes = np.cumsum([n * n, n**3, n * n, n])
        M, slopes, C, g, P = np.split(flat, sizes, axis=-1)
        square = (-1, n, n)
        return Right(
            M.reshape(square), slopes.reshape(-1, n, n, n), qd, C.reshape(square), g, P[:, 0]
        )

    def _columns(self, q, qd, arms) -> list[np.ndarray]:
        parameters = [
            np.array([getattr(arm, p.name) for arm in arms]) for p in self.mechanism.parameters
        ]
        return [*np.transpose(q), *np.transpose(qd), *parameters]

    @cached_property
    def _symbols(self) -> list[sp.Symbol]:
        m = self.mechanism
        return [*m.q, *m.qd, *(p.symbol for p in m.parameters)]

    @cached_property
    def _contributed(self) -> list[list[sp.Expr]]:
        derived = self.answer.of_kinetic or self.answer.of_potential
        assert derived is not None
        return [derived(term.energy, self.mechanism) for term in self.terms]

    def _of_whole(self) -> list[sp.Expr]:
        m = self.mechanism
        M = inertia(m.K, m)
        slopes = [e.diff(x) for e in M for x in m.q]
        return [*M, *slopes, *coriolis(m.K, m), *gradient(m.P, m), m.P]


def _plain(mechanism: Mechanism) -> sp.Tuple:
    """What the mistakes follow from, in SymPy's terms."""
    words = [str([mechanism.name, *mechanism.coordinates, *mechanism.parameters])]
    terms = (*mechanism.kinetic, *mechanism.potential)
    words += [term.name for term in terms]
    return sp.Tuple(*map(sp.Symbol, words), *(sp.sympify(term.energy) for term in terms))


def _listed(mask: np.ndarray | None) -> list | None:
    return None if mask is None else mask.tolist()


def _each_once(every, numbers, right) -> list:
    """Those with numbers of their own, in their order: not the right ones, nor an earlier one's."""
    scale = np.max(np.abs(right))
    flat = numbers.reshape(len(every), -1)
    kept: list[int] = []
    for i, own in enumerate(flat):
        others = np.array([right.ravel(), *flat[kept]])
        size = max(scale, np.max(np.abs(own)))
        if np.all(np.isfinite(own)) and np.all(np.max(np.abs(others - own), axis=1) > SAME * size):
            kept.append(i)
    return [every[i] for i in kept]
