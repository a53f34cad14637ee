"""`watch` shows a wrong answer at work: its motion or its curve beside the right one."""

import sys
from collections.abc import Mapping

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.verdict import State
from autograder.pictures.offers import CURVES, MOVES, WRONG, answer_of
from autograder.problems import known_check
from autograder.protocol import Call
from autograder.student.cell import VISIBLE_SEED, verdict_on
from autograder.student.display import show
from autograder.student.own_arm import drawn_for

NOTHING = {
    State.CORRECT: "The answer is right: there is nothing to compare.",
    State.NOT_ATTEMPTED: "There is no answer yet.",
}


def watch(id: str | None = None) -> None:
    """Show what the wrong answer to the check `id` does, from the worst case on its card.

    A wrong M, C, g_vec or f plays beside the right one; of g, P, a drift, an energy or a step's error
    there is a curve of yours and the right one. UnknownCheckError where no check has this id.
    """
    check = known_check(id, drawn_for(id))
    show(shown(check, sys._getframe(1).f_globals))


def shown(check: Check, namespace: Mapping) -> dict[str, str]:
    """What `watch` displays for the function in this namespace."""
    from autograder.pictures.page import (
        Shown,
        mimebundle,
    )  # nobody pays for it before it is asked for

    heading = f"{check.id}: yours and the right one"
    if not answer_of(check):
        said = f"There is no picture of {check.name}: its card says what there is to say."
        return mimebundle(heading, [Shown("", (said,))])
    verdict = verdict_on(check.id, namespace)
    if verdict.state not in WRONG or verdict.witness is None:
        said = NOTHING.get(
            verdict.state, f'There are no numbers of yours: see check("{check.id}").'
        )
        return mimebundle(heading, [Shown("", (said,))])
    # The same calls as the card's: a visible check draws them from the same seed each time.
    calls = check.calls(np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)
    worst = verdict.witness.of
    assert worst is not None
    return mimebundle(heading, list(_pictures(check, namespace[check.name], worst, calls)))


def _pictures(check: Check, function, worst: Call, calls: list[Call]):
    from autograder.pictures.curves import curves_of
    from autograder.pictures.differences import differences, sentences, title
    from autograder.pictures.equations import NoMotionError
    from autograder.pictures.motion import compared
    from autograder.pictures.page import Shown
    from autograder.pictures.side_by_side import picture

    name = answer_of(check)
    if name in MOVES:
        try:
            both = compared(check, function, worst)
        except NoMotionError as error:
            yield Shown("", (f"There is no motion to show: {error}.",))
        else:
            said = sentences(both)
            alt = f"{title(both)}. {' '.join(differences(both))}"
            drawn = picture(both, alt)
            yield Shown(title(both), said, drawn.svg, alt, drawn.motion)
    if name in CURVES and (made := curves_of(check)):
        try:
            with np.errstate(all="ignore"):  # theirs may run away
                curves = made(check, function, worst, calls)
        except NoMotionError as error:
            yield Shown("", (f"There is no curve of yours: {error}.",))
        else:
            alt = f"Two curves: {curves.title}. {' '.join(curves.said)}"
            yield Shown(curves.title, curves.said, curves.svg(alt), alt)
