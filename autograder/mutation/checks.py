"""Makes the checks of a mechanism: what is asked, the right answer, and every mistake that follows."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from autograder.judging.check import Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer
from autograder.mutation.answers.answer import states
from autograder.mutation.answers.composition import Composition, Numbers
from autograder.mutation.composed import catalogue_of
from autograder.mutation.mutant import Mutant
from autograder.mutation.references import contribution, reference
from autograder.mutation.sentences import sentence
from autograder.protocol import Call


def checks_of(mechanism: Mechanism) -> tuple[Check, ...]:
    """One check for each answer: `cart-pole-M`, `cart-pole-C` and so on."""
    return tuple(check_of(mechanism, answer) for answer in ANSWERS)


def check_of(mechanism: Mechanism, answer: str) -> Check:
    """The check of one answer. Its mistakes are made when the first answer is wrong."""
    asked = ANSWERS[answer]
    quantities, criteria = asked.judged(mechanism)
    return Check(
        id=f"{mechanism.name}-{answer}",
        signature=asked.signature,
        reference=reference(mechanism, answer),
        calls=partial(asked.calls, mechanism),
        quantities=quantities,
        criteria=criteria,
        terms=tuple(_terms(mechanism, asked)),
        catalogue=partial(_mistakes, mechanism, answer),
        hints=_hints(mechanism, asked),
        pose=lambda call: list(mechanism.points(asked.position(call.args), call.args[-1])),
    )


def mistakes_of(mechanism: Mechanism, answer: str) -> list[Mistake]:
    """Every mistake of an answer with its sentence."""
    return [
        Mistake(
            " / ".join(filter(None, _places(m))),
            partial(_one, mechanism, answer, k),
            sentence(m, mechanism, ANSWERS[answer]),
            whole=m.is_step,
            combines=m.operator not in ("doubled", "halved"),
        )
        for k, m in enumerate(catalogue_of(mechanism, answer).mutants)
    ]


def _places(mutant: Mutant) -> list[str]:
    return [
        *(mutant.operator, mutant.term, mutant.entry, mutant.put, mutant.instead_of),
        "in the energy" if mutant.in_energy else "",
        f"in {mutant.source}" if mutant.source else "",
    ]


def _mistakes(mechanism: Mechanism, answer: str, calls: list[Call]) -> list[tuple[Mistake, list]]:
    numbers = _numbers(mechanism, answer, [call.args for call in calls])
    return list(zip(mistakes_of(mechanism, answer), map(list, numbers), strict=True))


def _one(mechanism: Mechanism, answer: str, k: int, *args) -> np.ndarray:
    """What the k-th mistake returns for one call."""
    return _numbers(mechanism, answer, [args])[k, 0]


def _numbers(mechanism: Mechanism, answer: str, calls: list[tuple]) -> np.ndarray:
    composed = ANSWERS[answer].composition
    columns = composed(mechanism).columns(calls) if composed else states(calls)
    return catalogue_of(mechanism, answer).numbers(*columns)


def _terms(mechanism: Mechanism, asked: Answer) -> Iterator[Term]:
    for k, (term, _) in enumerate(asked.terms(mechanism)):
        yield Term(term.name, partial(_contribution, mechanism, asked.name, k))
    if asked.composition:
        composed = asked.composition(mechanism)
        for name, numbers in composed.terms.items():
            yield Term(name, partial(_part, composed, numbers))


def _contribution(mechanism: Mechanism, answer: str, k: int, *args) -> np.ndarray:
    return contribution(mechanism, answer, k)(*args)


def _part(composition: Composition, numbers: Numbers, *args) -> np.ndarray:
    return numbers(*composition.columns([args]))[0]


def _hints(mechanism: Mechanism, asked: Answer) -> tuple[str, ...]:
    """Which energy, of which bodies, into which entries; never a formula."""
    *others, last = asked.hints
    if others:
        return asked.hints
    parts = "; ".join(term.name for term, _ in asked.terms(mechanism))
    moving = " and ".join(c.name for c in mechanism.coordinates)
    of = (
        "kinetic energy K" if asked.of_kinetic else "",
        "potential energy P" if asked.of_potential else "",
    )
    zeros = "; ".join(f"{c.name} = 0 is {c.zero}" for c in mechanism.coordinates)
    return (
        f"Start from the {' and the '.join(filter(None, of))}. Which bodies and springs of this "
        f"mechanism have a part in it, as {moving} change?",
        f"The parts are: {parts}. And mind where the coordinates are zero: {zeros}.",
        last,
    )
