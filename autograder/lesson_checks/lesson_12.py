"""The checks of lesson 12, an arm that was measured."""

from math import degrees, pi, sqrt

from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("12-noise",),
    2: ("12-late", "c6-identify"),
    3: ("12-payload",),
    4: ("12-share",),
}

# An encoder of 16384 steps a turn, read every 2 ms.
STEP, TIME = 2 * pi / 16384, 0.002
ROUNDING = STEP / sqrt(12)

NOISE = Number(
    id="12-noise",
    text="the standard deviation of q̈ from rounding alone",
    unit="rad/s²",
    right=sqrt(6) * ROUNDING / TIME**2,
    wrong=(
        WrongNumber(
            "weights of one",
            sqrt(3) * ROUNDING / TIME**2,
            "You gave the three samples the same weight. How often does the middle one count, and what "
            "does that make of its variance?",
        ),
        WrongNumber(
            "middle squared no",
            2 * ROUNDING / TIME**2,
            "You added the weights as they are. Which power of a weight multiplies a variance?",
        ),
        WrongNumber(
            "errors added",
            4 * ROUNDING / TIME**2,
            "You let all errors point the same way. What adds up where errors are independent?",
        ),
        WrongNumber(
            "one error",
            ROUNDING / TIME**2,
            "You took the error of one sample. How many samples stand in the second difference, and "
            "with which weights?",
        ),
        WrongNumber(
            "whole step",
            sqrt(6) * STEP / TIME**2,
            "You took the whole step for the error of an angle. What is the standard deviation of a "
            "rounding error?",
        ),
        WrongNumber(
            "half a step",
            sqrt(6) * STEP / 2 / TIME**2,
            "You took the largest rounding error. Most are smaller: what is their standard deviation?",
        ),
        WrongNumber(
            "velocity",
            sqrt(2) * ROUNDING / (2 * TIME),
            "This is the noise of the velocity, by the central difference. What does the second "
            "difference divide by?",
        ),
        WrongNumber(
            "divided once",
            sqrt(6) * ROUNDING / TIME,
            "You divided by the time between samples once. How often does the second difference?",
        ),
        WrongNumber(
            "twice the time",
            sqrt(6) * ROUNDING / (2 * TIME) ** 2,
            "You took twice the time between samples. That belongs to the central difference: what "
            "stands below the second one?",
        ),
        WrongNumber(
            "counts",
            sqrt(6) / sqrt(12) / TIME**2,
            "Your number is in steps of the encoder. How many rad is a step?",
        ),
        WrongNumber(
            "degrees",
            degrees(sqrt(6) * ROUNDING / TIME**2),
            "Your number is in degrees. How many rad is a step?",
        ),
        WrongNumber(
            "the old encoder",
            4 * sqrt(6) * ROUNDING / TIME**2,
            "You took the encoder of the lesson's arm. How many steps a turn has this one?",
        ),
    ),
    otherwise=(
        "This is not the spread of a second difference of these rounded angles. Find the variance of "
        "one rounded angle first, then of the sum, then divide by the time."
    ),
    further=(
        "A better encoder that is read faster gives a worse second difference: the time counts twice, "
        "the step once."
    ),
    hints=(
        "The error of an angle has the variance of rounding. Three such errors are added, each with its "
        "weight.",
        "The variance of a sum of independent errors is the sum of their variances, each times the "
        "square of its weight. Then take the root and divide by the square of the time.",
    ),
)

LATE = Choice(
    id="12-late",
    text="what a delay that is left out does to the fit",
    options=(
        Option(
            "R² of the unseen run falls below 0.9, because every torque is compared with the wrong "
            "moment.",
            "How far does the torque of such a slow motion change in 12 ms? And the fit may bend its "
            "parameters to follow.",
        ),
        Option(
            "R² stays above 0.99, and the parameters stay right to 1 %, because 12 ms is about a "
            "hundredth of the shortest swing.",
            "A small error in the torque is not always small in each parameter. Which of them gives "
            "torques of the form that the error has?",
        ),
        Option(
            "R² stays above 0.99. All parameters come out too small by one factor, because late torques "
            "are smaller torques.",
            "A torque that comes late is as large as before. What does it look like beside the motion, "
            "a part of a swing later?",
        ),
        Option(
            "R² stays above 0.99. The viscous friction of joint 1 comes out a fifth too large, "
            "because the rate $\\dot u$ of the torque has a part that goes like $\\dot q$.",
        ),
    ),
    further=(
        "A filter that runs forwards only delays as well. Used on the angles alone, it does the same to "
        "the fit, with the opposite sign."
    ),
    hints=(
        "Write the late torque as the torque now, less a small time multiplied by its rate.",
        "For a swing, the third derivative of the angle goes like the first, with the opposite sign.",
    ),
)

BARE, LOADED, ADDED = 0.612, 1.512, 2.0 * 0.5
PAYLOAD = Number(
    id="12-payload",
    text="the true first moment of link 2",
    unit="kg·m",
    right=BARE * ADDED / (LOADED - BARE),
    wrong=(
        WrongNumber(
            "as recorded",
            BARE,
            "This is what the record says. By which factor is the moment of the payload off in it?",
        ),
        WrongNumber(
            "multiplied",
            BARE * (LOADED - BARE) / ADDED,
            "You found the factor and put it on the wrong side: is the record too small or too large?",
        ),
        WrongNumber(
            "the factor",
            (LOADED - BARE) / ADDED,
            "This is the factor of the recorder. What does it make of the arm's own moment?",
        ),
        WrongNumber(
            "loaded arm",
            LOADED * ADDED / (LOADED - BARE),
            "This is the moment of link 2 with the payload. Which one is asked for?",
        ),
        WrongNumber(
            "loaded for added",
            BARE * ADDED / LOADED,
            "You compared the payload with all that the loaded arm shows. Which part of that was there "
            "before?",
        ),
        WrongNumber(
            "mass alone",
            BARE * 2.0 / (LOADED - BARE),
            "You took the mass of the payload for its first moment. At which distance from the joint "
            "is it?",
        ),
        WrongNumber(
            "square of the length",
            BARE * 2.0 * 0.5**2 / (LOADED - BARE),
            "You took the payload's inertia. A first moment has which power of the length in it?",
        ),
        WrongNumber(
            "less the payload",
            LOADED - ADDED,
            "You took the payload's true moment from a number on the recorder's scale. Bring both to "
            "one scale first.",
        ),
    ),
    otherwise=(
        "Compare what the payload adds in the record with what it must add by its mass and place. That "
        "is the factor of the recorder."
    ),
    further="The other three base parameters, and the friction, are off by the same factor.",
    hints=(
        "By how much does the payload raise this parameter in the record? And by how much in truth?",
        "The quotient of the two is the factor between the record and the truth. All that the record "
        "says of the arm carries it.",
    ),
)

SHARE = Choice(
    id="12-share",
    text="what makes four base parameters too small by one factor",
    options=(
        Option(
            "The torques are recorded too small. Each $\\beta$ is found in proportion to them.",
        ),
        Option(
            "Link 2 is lighter than published. It is part of all four $\\beta$.",
            "Link 2 is part of all four, but in which of them does link 1 stand as well? What do these "
            "lose?",
        ),
        Option(
            "Link 1 is longer than the ruler said. $\\ell_1$ is in $\\beta_1$ and $\\beta_2$, and in "
            "$Y$.",
            "Two of the four have no length of link 1 in them. Why would they change as the others do?",
        ),
        Option(
            "The zero of one encoder is off. Then every torque of gravity is taken at a wrong angle.",
            "That spoils the terms with gravity. What would it do to the inertias, which stand with the "
            "accelerations?",
        ),
    ),
    further="Whether it is the only thing that does so is the question of the next section.",
    hints=(
        "Which of the four errors multiplies the whole left side or the whole right side of the "
        "equation by one number?",
        "Ask of each option whether it leaves one of the four as it was, or changes one more than "
        "the others.",
    ),
)

CHECKS = (NOISE, LATE, PAYLOAD, SHARE)
