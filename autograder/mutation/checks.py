"""Makes the checks of a mechanism: what is asked, the right answer, and every mistake that follows."""

from functools import partial

from autograder.judging.check import Check
from autograder.judging.terms import Term
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer
from autograder.mutation.following import follows
from autograder.mutation.further import further
from autograder.mutation.generated import Generated
from autograder.mutation.mistakes import parts_of
from autograder.mutation.references import reference
from autograder.mutation.sections import section
from autograder.mutation.sentences.notation import written


def check_of(mechanism: Mechanism, answer: str) -> Check:
    """The check of one answer. Its mistakes are made when the first answer is wrong."""
    asked = ANSWERS[answer]
    quantities, criteria = asked.judged(mechanism)
    return Check(
        id=f"{mechanism.name}-{answer}",
        signature=asked.signature,
        returns=asked.returned,
        reference=reference(mechanism, answer),
        calls=partial(asked.calls, mechanism),
        quantities=quantities,
        criteria=criteria,
        terms=partial(terms_of, mechanism, answer),
        catalogue=Generated(mechanism, answer),
        hints=_hints(mechanism, asked),
        section=section(mechanism, answer),
        further=further(mechanism, answer),
        follows=follows(mechanism, answer),
        pose=lambda call: list(mechanism.points(asked.position(call.args), call.args[-1])),
    )


def terms_of(mechanism: Mechanism, answer: str) -> tuple[Term, ...]:
    """These parts, as a check takes them."""
    return tuple(Term(name, model) for name, model in parts_of(mechanism, answer))


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
