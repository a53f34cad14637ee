"""All mistakes of one answer for one mechanism: wrong terms, wrong entries, wrong steps.

The numbers of all of them come from one compiled function, as each is the right answer plus what a
rewritten term contributes, less what the right one does.
"""

from collections.abc import Sequence
from dataclasses import astuple, replace
from functools import cached_property
from types import SimpleNamespace

import numpy as np
import sympy as sp

from autograder.mechanisms import EnergyTerm, Mechanism
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS, PARTS
from autograder.mutation.mutant import Mutant
from autograder.mutation.operators import OF_ENERGIES, astray, rewritings
from autograder.mutation.steps import STEPS, Right
from autograder.mutation.tape import Tape
from autograder.mutation.taping import taped
from autograder.mutation.whole import as_right, expressions

# To less than this share of the answer two mistakes give the same numbers.
SAME = 1e-7
CASES = 8
# Of one entry, what is done to a term of it; the other operators change all entries alike.
OF_AN_ENTRY = ("dropped", "wrong sign", "doubled", "halved", "wrong velocity")


class Catalogue:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Mechanism, answer: str):
        self.mechanism, self.answer = mechanism, (ANSWERS | PARTS)[answer]
        self._kept, self._of_term, self._tape = kept.entry(
            ("catalogue", sp.srepr(_definition(mechanism)), answer), self._made, self._read
        )

    def _made(self) -> dict:
        """All mistakes, as plain data."""
        self._wrong = list(self._rewritten())
        own = [e for entries in self._contributed for e in entries]
        wrong = [e for _, _, contributed, _ in self._wrong for e in contributed]
        self._of_term = np.array([k for k, *_ in self._wrong], dtype=int)
        self._tape = taped(self._symbols, [*expressions(self.mechanism), *own, *wrong])
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
                for mutant, of in each_once(every, numbers, right)
            ],
            "of_term": self._of_term.tolist(),
            "tape": self._tape.as_data(),
        }

    def _read(self, data: dict) -> tuple:
        of_term = np.array(data["of_term"], dtype=int)
        found = []
        for fields, of in data["mutants"]:
            if isinstance(of, str):
                STEPS[self.answer.name][of]  # KeyError where there is none
            else:
                of_term[of[0]]  # IndexError likewise
                of = (of[0], None if of[1] is None else np.array(of[1], dtype=float))
            found.append((Mutant(*fields), of))
        tape = Tape.from_data(data["tape"])
        entries = int(np.prod(self.answer.shape(self.mechanism.n)))
        expected = self._of_whole + (len(self.terms) + len(of_term)) * entries
        if len(tape.outputs) != expected:
            raise ValueError("the tape is not that of these mistakes")
        return found, of_term, tape

    def _rewritten(self):
        """(term, rewriting, what it contributes, whether it was made in the energy).

        What was done to a term of the answer itself is the simpler reading, so it comes first.
        """
        m = self.mechanism
        for k, (term, derived) in enumerate(self._derived):
            entries = sp.Tuple(*derived(term.energy, m))
            for rewriting in rewritings(entries, m):
                yield k, rewriting, list(rewriting.expressions), False
            if names := [name for name, _ in self._places()]:
                copies, moves = self._copies(), len(self.answer.shape(m.n)) == 1
                for rewriting in astray(entries, names, copies, moves):
                    yield k, rewriting, list(rewriting.expressions), False
        if self.answer.composition or not self.answer.shape(m.n):
            return  # it shows in the part that follows from the energy, or is done to it above
        for k, (term, derived) in enumerate(self._derived):
            for rewriting in rewritings(sp.Tuple(term.energy), m):
                if rewriting.operator in OF_ENERGIES:
                    continue  # no M follows from it
                yield k, rewriting, derived(rewriting.expressions[0], m), True

    @cached_property
    def _derived(self):
        return list(self.answer.terms(self.mechanism))

    @property
    def terms(self) -> list[EnergyTerm]:
        """The terms of the energies that the answer follows from."""
        return [term for term, _ in self._derived]

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
            return self._computed(q, qd, arms)[1]

    def _all(self) -> list[tuple[Mutant, object]]:
        """Each mistake with what its numbers are made of: a step's name, or (rewriting, entry)."""
        plain: list = [(Mutant(name), name) for name in STEPS.get(self.answer.name, ())]
        others: list = []
        alike: dict[Mutant, list[int]] = {}
        entries = []
        for r, (k, done, _, in_energy) in enumerate(self._wrong):
            at = (done.entry, done.put, done.instead_of, in_energy)
            mutant = Mutant(done.operator, self.terms[k].name, *at, detail=done.detail)
            (plain if done.operator in OF_AN_ENTRY else others).append((mutant, ([r], None)))
            if done.operator in OF_AN_ENTRY:
                for entry, mask in self._entries():
                    entries.append((replace(mutant, entry=entry, in_energy=False), ([r], mask)))
            if done.operator not in OF_AN_ENTRY or done.put:
                alike.setdefault(replace(mutant, term=""), []).append(r)
        for mutant, all_of_them in alike.items():
            if len({self._wrong[r][0] for r in all_of_them}) > 1:
                others.append((mutant, (all_of_them, None)))
        return plain + entries + others

    def _places(self) -> list[tuple[str, tuple[int, ...]]]:
        """The entries by name, with their indices, row by row; none of what has one entry alone."""
        n, shape = self.mechanism.n, self.answer.shape(self.mechanism.n)
        return [
            (self.answer.head + "".join(str(i + 1) for i in at), at)
            for at in (np.ndindex(shape) if n > 1 and shape else ())
        ]

    def _copies(self) -> list[int]:
        """For each entry the place of the one that equals it by symmetry."""
        places = [at for _, at in self._places()]
        return [places.index(at[::-1] if self.answer.symmetric else at) for at in places]

    def _entries(self) -> list[tuple[str, np.ndarray]]:
        """The entries by name, with where they are; M12 stands for M21 too."""
        found, copies = [], self._copies()
        for place, (name, _) in enumerate(self._places()):
            mask = np.zeros(self.answer.shape(self.mechanism.n))
            mask.flat[[place, copies[place]]] = 1
            if place <= copies[place]:
                found.append((name, mask))
        return found

    def _drawn(self, rng):
        m = self.mechanism
        arms = [arm for _ in range(CASES) for arm in 2 * [m.drawn(rng)]]  # each in two places
        size = len(arms)
        q = np.array([m.placed(rng) for _ in range(size)])
        qd = np.array([m.moving(rng) for _ in range(size)])
        return q, qd, arms

    def _numbers_of(self, chosen, q, qd, arms) -> np.ndarray:
        numbers, own, rewritten = self._computed(q, qd, arms)
        right = np.sum(own, axis=0)
        # Complex where q is, as slopes are taken by complex steps.
        found = np.empty((len(chosen), *right.shape), np.result_type(right, numbers.M))
        for i, (_, of) in enumerate(chosen):
            if isinstance(of, str):
                found[i] = STEPS[self.answer.name][of](numbers)
            else:
                which, mask = of
                change = sum(rewritten[r] - own[self._of_term[r]] for r in which)
                found[i] = right + (change if mask is None else mask * change)
        return found

    def _computed(self, q, qd, arms) -> tuple[Right, np.ndarray, np.ndarray]:
        """All right numbers; what the right terms contribute, and the rewritten ones: (…, cases, *shape)
        each.
        """
        flat = self._tape(np.array(self._columns(q, qd, arms)))
        numbers, flat = flat[: self._of_whole], flat[self._of_whole :]
        shape = self.answer.shape(self.mechanism.n)
        terms = np.moveaxis(flat.reshape(-1, *shape, len(q)), -1, 1)
        return as_right(numbers, qd), terms[: len(self.terms)], terms[len(self.terms) :]

    @property
    def _of_whole(self) -> int:
        """How many numbers of the tape are those of the whole mechanism."""
        n = self.mechanism.n
        return n * n + n**3 + n + 1

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
        return [derived(term.energy, self.mechanism) for term, derived in self._derived]


def _definition(mechanism: Mechanism) -> sp.Tuple:
    """What the mistakes follow from, in SymPy's terms."""
    energies = (*mechanism.kinetic, *mechanism.potential)
    words = [mechanism.name, *mechanism.coordinates, *mechanism.parameters]
    words += [len(mechanism.kinetic), *(term.name for term in energies), *mechanism.friction]
    formulas = [term.energy for term in energies] + [term.torque for term in mechanism.friction]
    return sp.Tuple(sp.Symbol(str(words)), *map(sp.sympify, formulas))


def _listed(mask: np.ndarray | None) -> list | None:
    return None if mask is None else mask.tolist()


def each_once(every, numbers, right) -> list:
    """Those with numbers of their own, in their order: not the right ones, nor an earlier one's."""
    scale = np.max(np.abs(right))
    flat = numbers.reshape(len(every), -1)
    found = np.empty((len(every) + 1, flat.shape[1]))
    found[0] = right.ravel()
    kept: list[int] = []
    for i, own in enumerate(flat):
        size = max(scale, np.max(np.abs(own)))
        apart = np.max(np.abs(found[: len(kept) + 1] - own), axis=1)
        if np.all(np.isfinite(own)) and np.all(apart > SAME * size):
            kept.append(i)
            found[len(kept)] = own
    return [every[i] for i in kept]
