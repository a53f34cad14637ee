"""Makes the checks of a mechanism: what is asked, the right answer, and every mistake that follows."""

from collections.abc import Mapping
from functools import lru_cache, partial
from types import SimpleNamespace

import numpy as np

from autograder.judging.check import Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer
from autograder.mutation.answers.answer import states
from autograder.mutation.answers.composition import Composition, Numbers
from autograder.mutation.composed import catalogue_of
from autograder.mutation.generated import Generated
from autograder.mutation.references import contribution, reference
from autograder.mutation.sentences import sentence
from autograder.mutation.sentences.notation import written
from autograder.protocol import Call


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
        terms=partial(terms_of, mechanism, answer),
        catalogue=Generated(mechanism, answer),
        hints=_hints(mechanism, asked),
        pose=lambda call: list(mechanism.points(asked.position(call.args), call.args[-1])),
    )


@lru_cache(maxsize=64)
def mistakes_of(mechanism: Mechanism, answer: str) -> list[Mistake]:
    """Every mistake of an answer with its sentence."""
    return [
        Mistake(
            m.name,
            partial(_one, mechanism, answer, k),
            sentence(m, mechanism, ANSWERS[answer]),
            whole=m.is_of_whole,
            of_all=answer == "C" and not m.is_of_a_product,
            combines=m.operator not in ("doubled", "halved"),
        )
        for k, m in enumerate(catalogue_of(mechanism, answer).mutants)
    ]


def numbers_of(mechanism: Mechanism, answer: str, calls: list[Call]) -> np.ndarray:
    """What each mistake returns for each call, (mistakes, calls, …).

    A call of symbols gives a number for each of its points. Where calls differ in their numbers of
    rows, as motions do, the array is one of objects, (mistakes, calls).
    """
    if calls[0].at:
        points = [_state(mechanism, point) for call in calls for point in call.at]
        return _numbers(mechanism, answer, points).reshape(-1, len(calls), len(calls[0].at))
    args = [call.args for call in calls]
    places: dict[tuple, list[int]] = {}
    for k, (first, *_) in enumerate(args):
        places.setdefault(np.shape(first), []).append(k)
    if len(places) == 1:
        return _numbers(mechanism, answer, args)
    found = np.empty((len(catalogue_of(mechanism, answer).mutants), len(calls)), dtype=object)
    for alike in places.values():
        numbers = _numbers(mechanism, answer, [args[k] for k in alike])
        for m, case in np.ndindex(numbers.shape[:2]):
            found[m, alike[case]] = numbers[m, case]
    return found


def _state(mechanism: Mechanism, point: Mapping[str, float]) -> tuple:
    """q, q̇ and the arm of a point at which an expression is tried, by the mechanism's names."""
    q, qd = (
        np.array([point[symbol.name] for symbol in symbols])
        for symbols in (mechanism.q, mechanism.qd)
    )
    return q, qd, SimpleNamespace(**{p.name: point[p.name] for p in mechanism.parameters})


def _numbers(mechanism: Mechanism, answer: str, calls: list[tuple]) -> np.ndarray:
    composed = ANSWERS[answer].composition
    columns = composed(mechanism).columns(calls) if composed else states(calls)
    return catalogue_of(mechanism, answer).numbers(*columns)


def _one(mechanism: Mechanism, answer: str, k: int, *args) -> np.ndarray:
    """What the k-th mistake returns for one call."""
    return _numbers(mechanism, answer, [args])[k, 0]


@lru_cache(maxsize=64)
def terms_of(mechanism: Mechanism, answer: str) -> tuple[Term, ...]:
    """The parts of the right answer, by the terms of the energies or the torques they come from."""
    asked = ANSWERS[answer]
    found = [
        Term(term.name, partial(_contribution, mechanism, answer, k))
        for k, (term, _) in enumerate(asked.terms(mechanism))
    ]
    if asked.composition:
        composed = asked.composition(mechanism)
        for name, numbers in composed.terms.items():
            found.append(Term(name, partial(_part, composed, numbers)))
    return tuple(found)


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
    *others, last_one = [c.name for c in mechanism.coordinates]
    several = bool(others)
    moving = f"{', '.join(others)} and {last_one} change" if several else f"{last_one} changes"
    zeros = "; ".join(f"{c.name} = 0 is {c.zero}" for c in mechanism.coordinates)
    first = {
        (True, False): f"kinetic energy K. Which bodies of this mechanism move as {moving}?",
        (
            False,
            True,
        ): f"potential energy P. Which bodies of this mechanism rise or fall as {moving}, and "
        "is there a spring that stretches?",
        (
            True,
            True,
        ): "kinetic energy K and the potential energy P. Which bodies of this mechanism move "
        f"as {moving}, which of them rise or fall, and is there a spring that stretches?",
    }[bool(asked.of_kinetic), bool(asked.of_potential)]
    said = (
        f"Start from the {first}",
        f"The parts are: {parts}. Mind where {'each coordinate' if several else 'the coordinate'} is "
        f"zero: {zeros}.",
        last,
    )
    return tuple(written(hint, mechanism) for hint in said)
