"""The file of a problem's own checks to fill in: a crane, and at each part what belongs there."""

OF_A_PROBLEM = '''\
"""The checks of the problem NAME. They work as they stand: change every part, from the top down."""

from math import sqrt
from types import SimpleNamespace

import numpy as np

from autograder.checks import Call, Check, Criterion, Mistake, array, each


# A random mechanism for each call. Choose ranges in which no part of an answer is small.
def crane(rng):
    return SimpleNamespace(
        mt=rng.uniform(1.0, 3.0),  # kg, mass of the trolley
        ml=rng.uniform(0.5, 2.0),  # kg, mass of the load
        l=rng.uniform(0.3, 1.2),  # m, length of the rope
        g=rng.uniform(2.0, 12.0),  # m/s²
    )


# The right answers. They take what a student's function takes, and never leave this file.
def small_swing(arm):
    return sqrt((arm.mt + arm.ml) * arm.g / (arm.mt * arm.l))


def M(q, arm):
    coupling = arm.ml * arm.l * np.cos(q[1])
    return np.array([[arm.mt + arm.ml, coupling], [coupling, arm.ml * arm.l**2]])


# What is tried: count calls, with random numbers from rng alone.
def swing_calls(rng, count):
    return [Call("small_swing", (crane(rng),)) for _ in range(count)]


def M_calls(rng, count):
    return [Call("M", (rng.uniform(-3.0, 3.0, 2), crane(rng))) for _ in range(count)]


# What is judged in one answer: an array for each criterion. Without it, an answer is one number.
@each
def entries(call, value):
    return (array(value, 2, 2),)


CHECKS = (
    Check(
        id="NAME-small_swing",  # the grade_id of its cell: anything, a hyphen, and the function's name
        signature="small_swing(arm)",
        reference=small_swing,
        calls=swing_calls,
        criteria=(Criterion("angular frequency of small swings", "rad/s"),),
        # A wrong model each, and what to say of it: what is seen, then where to look; never the formula.
        mistakes=(
            Mistake(
                "trolley held",
                lambda arm: sqrt(arm.g / arm.l),
                "Your frequency is that of a trolley which stands still. What does the trolley do while "
                "the load swings?",
            ),
        ),
        # From a nudge to nearly the way.
        hints=(
            "What moves besides the load?",
            "Write down both equations of motion for a small angle, and take x out of them.",
        ),
        # For whoever has it right.
        further="The heavier the trolley, the nearer it comes to a pivot that stands still.",
    ),
    Check(
        id="NAME-M",
        signature="M(q, arm)",
        reference=M,
        calls=M_calls,
        quantities=entries,
        criteria=(Criterion("inertia matrix"),),
        mistakes=(
            Mistake(
                "no coupling",
                lambda q, arm: np.diag(np.diag(M(q, arm))),
                "Your M has no coupling between trolley and load. What does the trolley feel when the "
                "load turns?",
            ),
        ),
        hints=("The kinetic energy has a product of both velocities. Which body brings it in?",),
    ),
)
'''

OF_THE_KIT = '''\
"""Mistakes that the problem NAME shall name besides those of the kit."""

from autograder.checks import Mistake

# By the id of a check: a name, the wrong model (with the arguments of the student's function), and what
# to say of it: what is seen, then where to look; never the formula. They come before those of the kit,
# so a wrong model that the kit knows is named by your sentence. The checks are:
#
LIST
MISTAKES = {
    # "ID": (
    #     Mistake(
    #         "twice the right one",
    #         lambda ARGUMENTS: …,
    #         "Your answer is twice the right one. Where have you counted something twice?",
    #     ),
    # ),
}
'''


def of_a_problem(name: str) -> str:
    """The text of the file for a problem of this name. It runs as it stands."""
    return OF_A_PROBLEM.replace("NAME", name)


def of_the_kit(name: str, checks: dict[str, str]) -> str:
    """The text of the file for a problem of the kit. checks: id → how the function is called."""
    listed = "\n".join(f"#   {id}: {signature}" for id, signature in checks.items())
    first, signature = next(iter(checks.items()))
    arguments = signature.partition("(")[2].removesuffix(")")
    text = OF_THE_KIT.replace("NAME", name).replace("LIST", listed)
    return text.replace("ID", first).replace("ARGUMENTS", arguments)
