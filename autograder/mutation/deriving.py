"""Derives all mistakes of one answer for one mechanism: wrong terms, wrong entries, wrong steps."""

from collections.abc import Iterator
from dataclasses import astuple, replace

import numpy as np
import sympy as sp

from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mutation.answers import Answer
from autograder.mutation.distinct import CASES, each_once
from autograder.mutation.formulas import symbols
from autograder.mutation.mutant import SELDOM_OF_AN_ENTRY, Mutant
from autograder.mutation.numbers import Made, Numbers
from autograder.mutation.operators import OF_ENERGIES, Rewriting, astray, rewritings
from autograder.mutation.steps import STEPS
from autograder.mutation.taping import taped
from autograder.mutation.whole import expressions

# Of one entry, what is done to a term of it; the other operators change all entries alike.
OF_AN_ENTRY = ("dropped", "wrong sign", "doubled", "halved", "wrong velocity")


class Deriving:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Mechanism, answer: Answer):
        self.mechanism, self.answer = mechanism, answer
        self._derived = list(answer.terms(mechanism))
        self._wrong = list(self._rewritten())

    def as_data(self) -> dict:
        """All mistakes, as plain data."""
        m = self.mechanism
        own = [e for term, derived in self._derived for e in derived(term.energy, m)]
        wrong = [e for _, _, contributed, _ in self._wrong for e in contributed]
        of_term = [k for k, *_ in self._wrong]
        tape = taped(symbols(m), [*expressions(m), *own, *wrong])
        computed = Numbers(m, self.answer, len(self._derived), of_term, tape)
        every = self._all()
        drawn = self._drawn(np.random.default_rng(0))
        with np.errstate(all="ignore"):
            numbers = computed.of(every, *drawn)
        right = computed.right(*drawn)
        if not self.answer.shape(m.n):  # of an energy only its changes count
            numbers, right = numbers[:, ::2] - numbers[:, 1::2], right[::2] - right[1::2]
        return {
            "mutants": [
                [astuple(mutant), of if isinstance(of, str) else [of[0], _listed(of[1])]]
                for mutant, of in each_once(every, numbers, right)
            ],
            "of_term": of_term,
            "tape": tape.as_data(),
        }

    def _rewritten(self) -> Iterator[tuple[int, Rewriting, list[sp.Expr], bool]]:
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

    @property
    def terms(self) -> list[EnergyTerm]:
        """The terms of the energies that the answer follows from."""
        return [term for term, _ in self._derived]

    def _all(self) -> list[tuple[Mutant, Made]]:
        """Each mistake with what its numbers are made of: a step's name, or (rewriting, entry)."""
        plain: list = [(Mutant(name), name) for name in STEPS.get(self.answer.name, ())]
        others: list = []
        alike: dict[Mutant, list[int]] = {}
        entries: list = []
        seldom: list = []
        for r, (k, done, _, in_energy) in enumerate(self._wrong):
            at = (done.entry, done.put, done.instead_of, in_energy)
            mutant = Mutant(done.operator, self.terms[k].name, *at, detail=done.detail)
            (plain if done.operator in OF_AN_ENTRY else others).append((mutant, ([r], None)))
            alone = entries if done.operator in OF_AN_ENTRY else seldom
            seldom_alone = done.operator in SELDOM_OF_AN_ENTRY and not in_energy
            if done.operator in OF_AN_ENTRY or seldom_alone:
                for entry, mask in self._entries():
                    alone.append((replace(mutant, entry=entry, in_energy=False), ([r], mask)))
            if done.operator not in OF_AN_ENTRY or done.put:
                alike.setdefault(replace(mutant, term=""), []).append(r)
        for mutant, all_of_them in alike.items():
            if len({self._wrong[r][0] for r in all_of_them}) > 1:
                others.append((mutant, (all_of_them, None)))
        return plain + entries + others + seldom

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


def _listed(mask: np.ndarray | None) -> list | None:
    return None if mask is None else mask.tolist()
