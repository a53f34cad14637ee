"""Which answers have a picture, and the sentence on a card that offers it. Light: every card asks."""

from collections.abc import Mapping

from autograder.judging.card import Line
from autograder.judging.check import Check
from autograder.judging.verdict import State, Verdict
from autograder.mutation.generated import Generated

WRONG = (State.INCORRECT, State.PARTLY_CORRECT)
# By the answer's name: what a student sees.
MOVES = {"M", "C", "g_vec", "f"}
CURVES = {
    "g_vec": "g over q",
    "potential_energy": "P over q",
    "energy_drift": "the drift over time",
    "simulate": "the energy over time",
    "rk4_step": "the error over the step",
}


def answer_of(check: Check) -> str:
    """The name of what it asks for, "" where there is no picture of it."""
    if isinstance(check.catalogue, Generated):
        name = check.catalogue.answer
        return name if name in MOVES or name in CURVES else ""
    return check.name if check.name in ("simulate", "rk4_step") else ""


def offer(verdict: Verdict, check: Check, namespace: Mapping) -> list[Line]:
    """The line of a card on wrong numbers of which there is a picture; none where there is not.

    namespace: the student's: without the name `watch` in it, the line brings the import too.
    """
    name = answer_of(check)
    if not name or verdict.state not in WRONG or verdict.witness is None:
        return []
    brought = "" if "watch" in namespace else "from autograder import watch; "
    moves = f"See what your {check.name} does to the motion" if name in MOVES else ""
    said = moves or f"See {CURVES[name]}, yours and the right one"
    return [Line.with_code(f"{said}: {{}}", f'{brought}watch("{check.id}")')]
