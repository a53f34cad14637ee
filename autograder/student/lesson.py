"""How a lesson's check is judged and shown: a card like a problem's, which never stops the lesson."""

from collections.abc import Mapping
from dataclasses import replace
from html import escape

import numpy as np

from autograder.judging import card
from autograder.judging.card import Line
from autograder.judging.check import VISIBLE_CASES, VISIBLE_SEED, Check
from autograder.judging.verdict import State, Verdict
from autograder.lesson_checks import LessonCheck
from autograder.lesson_checks.typed import CHANGE_IT, TYPE_IT
from autograder.protocol import answer_all
from autograder.student import failing, worst_case
from autograder.student.display import show

# A function's cell is the check's own cell, so both are run at once.
NEXT_STEPS = {
    State.NOT_ATTEMPTED: TYPE_IT,
    State.INCORRECT: CHANGE_IT,
    State.PARTLY_CORRECT: CHANGE_IT,
}


def show_card(check: LessonCheck, namespace: Mapping) -> None:
    """Judge the answer in this namespace and show its card. Whatever the verdict is, nothing is raised:
    the lesson goes on below.
    """
    verdict = verdict_on(check, namespace)
    if verdict.state is not State.NOT_ATTEMPTED:
        failing.note(verdict)
    worst_case.remember(verdict)
    show(card.mimebundle(verdict, _below(check, verdict)))


def verdict_on(check: LessonCheck, namespace: Mapping) -> Verdict:
    """The verdict on what the namespace has for this check."""
    if not isinstance(check, Check):
        return check.judge(namespace)
    rng = np.random.default_rng(VISIBLE_SEED)
    verdict = check.run(lambda calls: answer_all(calls, namespace), rng, VISIBLE_CASES)
    return replace(verdict, next_step=NEXT_STEPS.get(verdict.state, verdict.next_step))


def _below(check: LessonCheck, verdict: Verdict) -> list[Line]:
    """The hint to call, if the answer is not right."""
    if verdict.state in (State.CORRECT, State.CHECK_FAILED):
        return []
    hint = f'hint("{check.id}")'
    said = "Stuck? Run {} for a hint."
    return [Line(said.format(hint), said.format(f"<code>{escape(hint)}</code>"))]
