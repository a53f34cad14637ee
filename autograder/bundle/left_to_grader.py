"""The checks that need the equations themselves, for arms and states that a student chooses or a run
brings up. No stored numbers can stand for them.
"""

from collections.abc import Callable
from functools import partial

from autograder.judging.check import Check
from autograder.judging.loops import Loop
from autograder.judging.quantities import vector
from autograder.problems.p1_inertia.checks import arm_and_q
from autograder.problems.p4_gravity.checks import configurations
from autograder.protocol import Call
from autograder.stored.asking import visible_calls

OF_ANY_ARM = (
    "Whether an arm of your choice is singular follows from the equations that this problem asks you "
    "for, and they are not in this package."
)
OF_ANY_CONFIGURATION = (
    "Whether a configuration of your choice is an equilibrium follows from the gravity vector that "
    "this problem asks you for, and it is not in this package."
)
OF_A_RUN = (
    "Your controller is judged in closed loop, and the equations of the simulated arm are not in this "
    "package."
)
WHY = {"p1-singular_arm": OF_ANY_ARM, "p4-equilibria": OF_ANY_CONFIGURATION}
FORMS: dict[str, Callable] = {"p1-singular_arm": arm_and_q, "p4-equilibria": configurations}


def why_left_out(check: Check) -> str:
    """Why a student's package leaves this check to the grader; "" where it does not."""
    if check.id in WHY:
        return WHY[check.id]
    return OF_A_RUN if any(isinstance(call, Loop) for call in visible_calls(check)) else ""


def form_of(check: Check) -> Callable:
    """What reads a value for such a check, without any equations; UnfitError where the value does not
    have the form that is asked for.
    """
    if check.id in FORMS:
        return FORMS[check.id]
    call = next(call for call in visible_calls(check) if not isinstance(call, Loop))
    return partial(vector, n=len(check.reference(*call.args)))


def plain(call: Call) -> Call:
    """The call; of a loop, that of its first step."""
    return Call(call.name, call.args, call.at, call.parts, call.truth, call.without)
