"""The checks of lesson 13, the whole course before an exam."""

from math import cos, radians, sin, sqrt

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import UnfitError, each, vector
from autograder.judging.terms import Term
from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("13-momentum",),
    2: ("13-library",),
    3: ("13-heat",),
    4: ("13-swing", "13-scale"),
}


def _arms(rng, count):
    """A Christoffel C, velocities, and the torques of motors, friction and gravity."""
    calls = []
    for _ in range(count):
        n = rng.integers(2, 5)
        torques = rng.uniform(-3, 3, size=(4, n))
        calls.append(Call("my_momentum", (rng.uniform(-2, 2, size=(n, n)), *torques)))
    return calls


@each
def _rates(call, value):
    n = len(call.args[1])
    if np.shape(value) == (n, n):
        raise UnfitError(
            f"an array of shape {(n, n)}, as C has; it must return shape ({n},), one number for each "
            "joint"
        )
    return (vector(value, n),)


MOMENTUM = Check(
    id="13-momentum",
    signature="my_momentum(C, qd, u, f_vec, g_vec)",
    reference=lambda C, qd, u, f, g: u - f - g + C.T @ qd,
    calls=_arms,
    quantities=_rates,
    criteria=(Criterion("the rate of the momentum of all joints", "N·m"),),
    terms=(
        Term("the motors' torque", lambda C, qd, u, f, g: u),
        Term("friction", lambda C, qd, u, f, g: -f),
        Term("gravity", lambda C, qd, u, f, g: -g),
        Term("the velocity term", lambda C, qd, u, f, g: C.T @ qd),
    ),
    mistakes=(
        Mistake(
            "M q̈",
            lambda C, qd, u, f, g: u - f - g - C @ qd,
            "This is M q̈. The momentum is a product: what else in it changes while the arm moves?",
        ),
        Mistake(
            "not transposed",
            lambda C, qd, u, f, g: u - f - g + C @ qd,
            "Only the velocity term is wrong. Put the rate of M in, with C and its transpose: which of "
            "the two is left?",
        ),
        Mistake(
            "rate of M twice",
            lambda C, qd, u, f, g: u - f - g + (C + C.T) @ qd,
            "You added the whole rate of M to the torques. M q̈ has a velocity term, too: with which "
            "sign?",
        ),
        Mistake(
            "no velocity term",
            lambda C, qd, u, f, g: u - f - g,
            "These are the torques alone. In Euler–Lagrange, which slope of K stands beside them?",
        ),
        Mistake(
            "transposed, with a minus",
            lambda C, qd, u, f, g: u - f - g - C.T @ qd,
            "Only the sign of the velocity term is wrong. On which side of Euler–Lagrange does the "
            "slope of K by q stand?",
        ),
        Mistake(
            "halved",
            lambda C, qd, u, f, g: u - f - g + C.T @ qd / 2,
            "Your velocity term is half of the right one. The ½ of K is in C already.",
        ),
        Mistake(
            "gravity added",
            lambda C, qd, u, f, g: u - f + g + C.T @ qd,
            "Your gravity pushes the wrong way. On which side of the equation of motion does g stand?",
        ),
        Mistake(
            "friction added",
            lambda C, qd, u, f, g: u + f - g + C.T @ qd,
            "Your friction drives the arm. On which side of the equation of motion does f stand?",
        ),
        Mistake(
            "gravity left out",
            lambda C, qd, u, f, g: u - f + C.T @ qd,
            "Gravity is missing: an arm that is let go gains momentum, too.",
        ),
        Mistake(
            "friction left out",
            lambda C, qd, u, f, g: u - g + C.T @ qd,
            "Friction is missing: it takes momentum from a joint that turns.",
        ),
        Mistake(
            "sign of the whole",
            lambda C, qd, u, f, g: f + g - u - C.T @ qd,
            "The sign is reversed: a motor that pushes forwards makes the momentum grow.",
        ),
    ),
    hints=(
        "Two ways lead there: Euler–Lagrange says what the rate of ∂L/∂q̇ is; or differentiate M q̇ as "
        "a product, and put the equation of motion in.",
        "By the second way you have M q̈ and the rate of M times the velocities. Write the rate of M "
        "with C, and see what cancels.",
    ),
    further=(
        "What is left over when a robot compares this with the momentum that it has is an outside "
        "torque: a collision, found without measuring an acceleration."
    ),
)

LIBRARY = Choice(
    id="13-library",
    text="which programs need the Christoffel C",
    options=(
        Option(
            "None: the new $C$ is valid, so all four compute what they did.",
            "A valid C gives the right product with q̇. Which of the four use C in another way?",
        ),
        Option(
            "The third and the fourth: they use more of $C$ than its product with $\\dot q$.",
        ),
        Option(
            "The first and the fourth: these two move the arm, and another $C$ moves it differently.",
            "The simulator needs C only in a product with q̇. Does that product depend on the choice?",
        ),
        Option(
            "The second, the third and the fourth: each of them rests on a skew-symmetric "
            "$\\dot M - 2C$.",
            "One of these three rests on less. For which vectors does the balance of the energy need "
            "the product with the matrix to be zero?",
        ),
    ),
    further=(
        "So ask a library once: is C plus its transpose the rate of M? Two calls of M close to each "
        "other tell."
    ),
    hints=(
        "For each program, write down every place where C stands, and what it is multiplied by.",
        "A valid C promises the product with q̇. The table above says what the Christoffel C promises "
        "besides.",
    ),
)

# The largest torques of the directions of link 1 and of link 2, N·m.
A = (ARM.m1 * ARM.lc1 + ARM.m2 * ARM.l1) * ARM.g
B = ARM.m2 * ARM.lc2 * ARM.g

HEAT = Number(
    id="13-heat",
    text="the heat that friction has made",
    unit="J",
    right=A + B,
    wrong=(
        WrongNumber(
            "from upright",
            2 * (A + B),
            "This is the heat of an arm that falls from upright. How high are the centres of mass here?",
        ),
        WrongNumber(
            "link 2 as if about joint 2",
            B,
            "This is link 2 alone, falling about its own joint. How far do both links sink?",
        ),
        WrongNumber(
            "elbow at rest",
            (ARM.m1 * ARM.lc1 + ARM.m2 * ARM.lc2) * ARM.g,
            "You forgot that the elbow sinks, too. How far does the centre of mass of link 2 sink?",
        ),
        WrongNumber(
            "link 2 to the elbow",
            A,
            "You let link 2 sink as far as the elbow. How far does its centre of mass sink?",
        ),
        WrongNumber(
            "ends of the links",
            (ARM.m1 * ARM.l1 + ARM.m2 * (ARM.l1 + ARM.l2)) * ARM.g,
            "You put the weights at the ends of the links. Where do they act?",
        ),
        WrongNumber(
            "mass for weight",
            (A + B) / ARM.g,
            "A mass times a height is not yet an energy. What does each link weigh?",
        ),
        WrongNumber(
            "sign",
            -(A + B),
            "The size is right. Heat is what the arm has lost: which sign has it?",
        ),
        WrongNumber(
            "link 1 alone",
            ARM.m1 * ARM.lc1 * ARM.g,
            "This is what link 1 gives. Link 2 sinks as well.",
        ),
        WrongNumber(
            "half",
            (A + B) / 2,
            "This is half of it. Nothing is left in the arm at the end: where would the other half be?",
        ),
    ),
    otherwise=(
        "The heat is the energy at the start less that at the end. Where does this arm come to rest, "
        "and how far has each centre of mass sunk there?"
    ),
    further=(
        "Neither the inertias nor the coefficients of friction are in it: they say how long it takes, "
        "and by which way."
    ),
    hints=(
        "There is no kinetic energy at the start, and none at the end. What does the rest of the "
        "balance say?",
        "Viscous friction holds nothing at rest, so the arm ends in a stable equilibrium: hanging. Find "
        "the height of both centres of mass there and at the start.",
    ),
)

START, LEVEL = radians(120), 8.0  # rad, rad/s²
SWING = Number(
    id="13-swing",
    text="how fast it turns at the bottom",
    unit="rad/s",
    right=sqrt(2 * LEVEL * (1 - cos(START))),
    wrong=(
        WrongNumber(
            "height from above",
            sqrt(2 * LEVEL * (1 + cos(START))),
            "You have the height that is left above the start. How far down is it to the bottom?",
        ),
        WrongNumber(
            "half forgotten",
            sqrt(LEVEL * (1 - cos(START))),
            "A factor is missing under the root. What stands before I q̇² in the kinetic energy?",
        ),
        WrongNumber(
            "from level",
            sqrt(2 * LEVEL),
            "This is the speed after a start from 90°. It starts higher.",
        ),
        WrongNumber(
            "root forgotten",
            2 * LEVEL * (1 - cos(START)),
            "This is the square of the speed.",
        ),
        WrongNumber(
            "acceleration held constant",
            sqrt(2 * LEVEL * START),
            "You let it turn with the same acceleration all the way. How does that change with q?",
        ),
        WrongNumber(
            "sine for height",
            sqrt(2 * LEVEL * sin(START)),
            "The sine says how strongly gravity turns it there. Which function of q is the height?",
        ),
        WrongNumber(
            "point mass",
            sqrt(2 * 9.81 * (1 - cos(START))),
            "You took a point mass on a rod of 1 m. What do the two measurements say of this pendulum?",
        ),
        WrongNumber(
            "torque for inertia",
            sqrt(2 * 6.0 * (1 - cos(START))),
            "You took the torque for the acceleration at 90°. Which number does the motion need?",
        ),
    ),
    otherwise=(
        "The potential energy at the start becomes kinetic energy at the bottom. Both have a factor "
        "that you can measure, m g ℓc and I: which combination of them do you need?"
    ),
    further=(
        "The torque was not needed: only the ratio of m g ℓc to I is in a free swing, and the "
        "acceleration at 90° is this ratio."
    ),
    hints=(
        "Write down the equation of motion at 90°, at rest, without a motor. What is its acceleration?",
        "Set ½ I q̇² equal to the potential energy of the start, divide by I, and look for what was "
        "measured.",
    ),
)

SCALE = Choice(
    id="13-scale",
    text="what torques that are all 20 % too large spoil",
    options=(
        Option(
            "$m g\\ell_c$ alone, because $I$ came from an acceleration, and no torque was measured "
            "there.",
            "What did you divide by that acceleration to find I?",
        ),
        Option(
            "All three, because each of them rests on the two measurements.",
            "Write the speed with m g ℓc and I in it. In which combination do they stand there?",
        ),
        Option(
            "None, because a common factor cancels in an equation that is linear in the parameters.",
            "Linear means the opposite for the parameters: with torques that are larger by a factor, "
            "what becomes of the solution?",
        ),
        Option(
            "$m g\\ell_c$ and $I$, by the same factor; the speed has only their ratio in it.",
        ),
    ),
    further="Weigh one part, or add a known load: that is the cheapest way to the scale.",
    hints=(
        "Do both measurements again with torques that are 1.2 times as large, and write down what you "
        "get.",
        "Every torque of this pendulum is linear in m g ℓc and I. Which numbers are the same after both "
        "have been multiplied by one factor?",
    ),
)

CHECKS = (MOMENTUM, LIBRARY, HEAT, SWING, SCALE)
