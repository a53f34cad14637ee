"""`check`, which a student's cell calls, and how the cell shows the verdict."""

import os
import sys
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial

import numpy as np

from autograder.judging import card
from autograder.judging.carried.judge import Carrying
from autograder.judging.check import HIDDEN_CASES, SLOW, VISIBLE_CASES, VISIBLE_SEED, Check
from autograder.judging.passages import filled
from autograder.judging.verdict import State, Verdict
from autograder.lesson_checks import known as known_in_lesson
from autograder.pictures.offers import offer
from autograder.problems import CHECKS, UnknownCheckError, check_for, known_check, own_checks
from autograder.problems.own_mechanisms import files_here
from autograder.proofs import derivation_of
from autograder.protocol import Call, Fault, FaultKind, Reply, answer_all, no_limit
from autograder.student import (
    below,
    failing,
    in_grading,
    lesson,
    progress,
    unquoted,
    version,
    worst_case,
)
from autograder.student import fresh as fresh_cases
from autograder.student.definitions import watched
from autograder.student.display import say, show
from autograder.student.own_arm import drawn_for, reminder
from autograder.student.pasted import as_pasted

_definitions = watched({check.name for check in CHECKS.values()} | own_checks.names_here())
_cells = in_grading.watched()
unquoted.watch()


class NotCorrectError(Exception):
    """The answer is not correct yet. Its traceback is the verdict, not the way through our code.

    said: the card as plain text.
    """

    def __init__(self, verdict: Verdict, said: str):
        super().__init__(verdict.headline)
        self.verdict = verdict
        self.said = said

    def _render_traceback_(self):
        # `nbgrader validate` shows errors alone, not the card above them.
        if os.environ.get("NBGRADER_EXECUTION"):
            return self.said.splitlines()
        return [f"{self.verdict.headline}: see the card above."]


class NotInGradingError(Exception):
    """The answer is correct here, and the notebook will not do the same when it is graded."""

    def _render_traceback_(self):
        return str(self).splitlines()


def check(id: str | None = None, fresh: bool = False) -> None:
    """Judge the function that the check `id` asks for, as this notebook defines it; show the verdict.

    The visible check tries a few fixed cases; `fresh=True` draws new ones each time, as the grader
    does, but in a student's package, which says that it cannot. NotCorrectError, after the card, where
    the verdict is not "correct", save in a lesson, which goes on; UnknownCheckError where no check has
    this id.
    """
    if asked := known_in_lesson(id):
        lesson.show_card(asked, sys._getframe(1).f_globals)
        return
    if isinstance(id, str) and derivation_of(id):
        raise UnknownCheckError(f"no check judges {id!r}: call derivation with its lines")
    if said := version.remark(str(id)):
        say(said)
    namespace = sys._getframe(1).f_globals
    verdict = _naming_an_old_function(verdict_on(known_check(id).id, namespace, fresh))
    failing.note(verdict)
    progress.note(verdict)
    worst_case.remember(verdict)
    pictured = offer(verdict, known_check(id), namespace)
    shown = card.mimebundle(verdict, below.lines(verdict, pictured), below.points(verdict))
    show(shown)
    for broken in own_checks.broken(own_checks.files_here()):
        say(broken)
    _tell_of_no_limit()
    if fresh and (said := fresh_cases.refusal()):
        say(said)
    if said := reminder(id):
        say(said)
    told = in_grading.told(verdict.check, _cells)
    for one in told:
        say(f"When it is graded: {one.said}")
    if verdict.state not in (State.CORRECT, State.NOT_HERE):
        raise NotCorrectError(verdict, shown["text/plain"])
    costs = [one.said for one in told if one.costs]
    if costs and os.environ.get("NBGRADER_EXECUTION"):
        head = f"{verdict.headline}, but not when it is graded."
        raise NotInGradingError("\n".join([head, *map(filled, costs)]))  # Validate cuts long lines


def verdict_on(id: str, namespace: Mapping, fresh: bool = False) -> Verdict:
    """The verdict on the function in a namespace that a known check asks for."""
    rng = np.random.default_rng(None if fresh else VISIBLE_SEED)
    count = HIDDEN_CASES if fresh else VISIBLE_CASES
    judged = known_check(id, drawn_for(id))
    name = judged.name
    asked: list[Call] = []

    def ask(calls: list[Call]) -> list[Reply]:
        replies = answer_all(calls, namespace)
        asked.extend(() if asked else calls)
        error = _definitions.missing(name) if _definitions else ""
        if error and replies[0].fault and replies[0].fault.kind is FaultKind.MISSING:
            return [Reply(fault=Fault(FaultKind.CELL_FAILED, error))]
        return replies

    started = time.process_time()
    verdict = judged.run(ask, rng, count, Carrying(partial(_earlier, id)))
    quick = time.process_time() - started < SLOW  # on a busy machine too
    return as_pasted(verdict, judged, ask, asked, namespace) if quick else verdict


def _earlier(later: str, id: str) -> Check | None:
    """The check of an answer that comes before that of the check `later`, on the same arm."""
    return check_for(id, drawn_for(later), files_here(id))


@cache  # once in a kernel
def _tell_of_no_limit() -> None:
    if said := no_limit():
        say(said)


def _naming_an_old_function(verdict: Verdict) -> Verdict:
    """The verdict; if it is on an old function, its problem says so first."""
    name = known_check(verdict.check).name
    error = _definitions.old(name) if _definitions else ""
    if not error:
        return verdict
    said = f"This is your old {name}: the cell that should define it again stopped with {error}."
    return replace(verdict, problem=f"{said} {verdict.problem}".rstrip())
