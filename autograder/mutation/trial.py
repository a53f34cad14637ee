"""Tries the checks of a mechanism: right answers in several styles, and every mistake."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.verdict import State, Verdict
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.generated import Generated
from autograder.mutation.styles import STYLES
from autograder.protocol import Call, Reply, read, real


def nothing_to_ask(mechanism: Mechanism, answer: str) -> str:
    """Why a problem cannot ask for an answer: it is 0 for every motion, so that zeros earn all points.

    Empty if it can. Tried in numbers, on what the check judges: of P only the changes.
    """
    check = check_of(mechanism, answer)
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    right = [check.reference(*map(real, call.args)) for call in calls]
    judged = [part for parts in check.quantities(calls, right) for part in parts]
    if any(np.any(np.abs(part) > 1e-12) for part in judged):
        return ""
    of = "the change of P" if answer == "potential_energy" else ANSWERS[answer].head
    return f"{of} of {mechanism.name} is 0 for every motion: ask for something else"


def tried(
    mechanism: Mechanism, asks: Sequence[str] = tuple(ANSWERS), names: bool = False
) -> Iterator[tuple[str, bool]]:
    """Line by line what students will read, each with whether it is as it should be.

    names: with the name of each mistake, by which a teacher's own sentence finds it.
    """
    answers = tuple(f"{answer}: " for answer in ANSWERS)
    for row in dict(mechanism.sentences):
        if not row.startswith(answers):
            yield f"the sentence for {row!r} is for none of {', '.join(ANSWERS)}", False
    for answer in asks:
        check = check_of(mechanism, answer)
        if why := nothing_to_ask(mechanism, answer):
            yield f"{check.id}: {why}", True
            continue
        wrong_styles = [
            style
            for style, given in STYLES.items()
            if _asked(check, partial(_right, check, given)).state is not State.CORRECT
        ]
        refused = f", but not {', '.join(wrong_styles)}" if wrong_styles else ""
        yield f"{check.id}: the right answer is correct{refused}", not wrong_styles
        made = Generated(mechanism, answer)
        for row in made.unused():
            yield f"  the sentence for {f'{answer}: {row}'!r} fits no mistake", False
        known = made.mistakes()
        for k, mistake in enumerate(known):
            verdict = _asked(check, partial(_given, check, k))
            named = verdict.diagnosis == (mistake.sentence,)
            yield (
                f"  {' '.join(verdict.diagnosis) or f'(nothing is said of {mistake.name})'}",
                named,
            )
            if names:
                yield f"      {answer}: {mistake.name}", True
        yield f"  {len(known)} mistakes", True


def _right(check: Check, style: Callable, calls: list[Call]) -> list:
    """The right answers in this style, read as a student's are."""
    return [read(call, style(check.reference(*map(real, call.args)))) for call in calls]


def _given(check: Check, k: int, calls: list[Call]) -> list:
    """What the k-th mistake returns for all calls, in one step."""
    assert check.catalogue is not None
    _, values = check.catalogue(calls)[k]
    return list(values)


def _asked(check: Check, answers: Callable[[list[Call]], list]) -> Verdict:
    def ask(calls: list[Call]) -> list[Reply]:
        return [Reply(value=value) for value in answers(calls)]

    return check.run(ask, np.random.default_rng(20260101), VISIBLE_CASES)
