"""The checks that need the equations themselves, for arms and states that a student chooses or a run
brings up. No stored numbers can stand for them.
"""

from autograder.judging.check import Check
from autograder.judging.loops import Loop
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


def why_left_out(check: Check) -> str:
    """Why a student's package leaves this check to the grader; "" where it does not."""
    if check.id in WHY:
        return WHY[check.id]
    return OF_A_RUN if any(isinstance(call, Loop) for call in visible_calls(check)) else ""
