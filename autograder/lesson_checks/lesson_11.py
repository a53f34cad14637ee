"""The checks of lesson 11, a robot in space."""

from math import cos, radians, sin

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("11-triangle",),
    2: ("11-fling", "p1-inertia_from_links"),
    3: ("11-gear",),
    4: ("11-feel",),
    5: ("11-wall",),
}

# The forearm of the lesson's PUMA 560: principal moments, kg·m².
XX, YY, ZZ = 0.066, 0.0125, 0.086

TRIANGLE = Number(
    id="11-triangle",
    text="the largest Izz that a body with these Ixx and Iyy can have",
    unit="kg·m²",
    right=XX + YY,
    wrong=(
        WrongNumber(
            "the larger of the two",
            XX,
            "You kept Izz no larger than Ixx. A flat disc has one moment that is larger than either of "
            "the others: how large can it be?",
        ),
        WrongNumber(
            "difference of the two",
            XX - YY,
            "You subtracted the two moments. This is the least that Izz can be, and the most is asked "
            "for.",
        ),
        WrongNumber(
            "as printed",
            ZZ,
            "This is the printed number. Does it meet the rule of this section?",
        ),
        WrongNumber(
            "what is missing",
            ZZ - XX - YY,
            "This is by how much the printed number is too large. What is left of it?",
        ),
        WrongNumber(
            "about the joint",
            XX + YY + 4.8 * 0.07**2,
            "You moved the moment to the joint. All three moments here are about the centre of mass.",
        ),
    ),
    otherwise=(
        "This is not the bound that the other two moments set. Which integral is it that must not be "
        "negative?"
    ),
    further="At the bound the body is flat: all of its mass lies in one plane, across the z axis.",
    hints=(
        "Which sum and difference of the three moments is twice the integral of z² dm?",
        "That integral is never negative. When is it zero, and what is Izz then?",
    ),
)

# Shoulder at −45°, elbow at 90°, the waist turns at 2 rad/s: the links' angles, and the distances of
# their centres of mass from the waist's axis, with the slopes of these in q2.
UPPER, FORE = radians(-45), radians(45)
X2, DX2 = 0.068 * cos(UPPER) - 0.006 * sin(UPPER), -0.068 * sin(UPPER) - 0.006 * cos(UPPER)
X3 = 0.4318 * cos(UPPER) + 0.070 * sin(FORE)
DX3 = -0.4318 * sin(UPPER) + 0.070 * cos(FORE)
SLOPE = 2 * (17.4 * X2 * DX2 + 4.8 * X3 * DX3)
SLOPE += (0.130 - 0.524) * sin(2 * UPPER) + (XX - YY) * sin(2 * FORE)
WEIGHT = -9.81 * (17.4 * X2 + 4.8 * X3)
ELBOW_SLOPE = 2 * 4.8 * X3 * 0.070 * cos(FORE) + (XX - YY) * sin(2 * FORE)

FLING = Number(
    id="11-fling",
    text="what the shoulder's motor must add while the waist turns",
    unit="N·m",
    right=-SLOPE / 2 * 2**2,
    wrong=(
        WrongNumber(
            "sign",
            SLOPE / 2 * 2**2,
            "The size is right. This is the torque that flings the arm; the motor has to hold against "
            "it.",
        ),
        WrongNumber(
            "speed not squared",
            -SLOPE / 2 * 2,
            "This is an entry of C. What is C multiplied by in the equation of motion?",
        ),
        WrongNumber(
            "without the half",
            -SLOPE * 2**2,
            "This is twice the right size. A Christoffel symbol has a factor in front: which?",
        ),
        WrongNumber(
            "with gravity",
            WEIGHT - SLOPE / 2 * 2**2,
            "This is all that the motor gives. Only what comes in addition to rest is asked for.",
        ),
        WrongNumber(
            "gravity alone",
            WEIGHT,
            "This is what the motor gives at rest. What comes in addition when the waist turns?",
        ),
        WrongNumber(
            "the elbow's row",
            -ELBOW_SLOPE / 2 * 2**2,
            "This is what the elbow's motor must add. Which row is the shoulder's?",
        ),
    ),
    otherwise=(
        "Only the waist moves, at a constant speed, and gravity is there at rest, too. Which term of "
        "the equation of motion is left, and which row of it is the shoulder's?"
    ),
    further="The arm is flung outwards, as a skater's arms are: M11 grows when the shoulder sinks.",
    hints=(
        "At a constant speed q̈ is zero. What does q̇ look like if only the waist moves?",
        "The library has C: set q and q̇ as arrays, in rad, and take the second entry of C q̇.",
    ),
)

RATIO, ROTOR = 107.815, 409e-6
MOTOR = RATIO**2 * ROTOR
GEAR = Number(
    id="11-gear",
    text="what the motor adds to M22 with the new gear",
    unit="kg·m²",
    right=MOTOR / 4,
    wrong=(
        WrongNumber(
            "halved",
            MOTOR / 2,
            "You halved what it adds now. With which power does the ratio enter?",
        ),
        WrongNumber(
            "as before",
            MOTOR,
            "This is what the motor adds with the old gear.",
        ),
        WrongNumber(
            "what is saved",
            MOTOR * 3 / 4,
            "This is by how much M22 falls. What is left of the motor's part?",
        ),
        WrongNumber(
            "twice the ratio",
            MOTOR * 4,
            "You doubled the ratio. The new motor turns half as often for each turn of the joint.",
        ),
        WrongNumber(
            "ratio not squared",
            RATIO / 2 * ROTOR,
            "You have the ratio once. It is in the rotor's speed, and the speed is squared in the "
            "energy.",
        ),
        WrongNumber(
            "rotor alone",
            ROTOR,
            "This is the rotor about its own shaft. How does the joint feel it through the gear?",
        ),
    ),
    otherwise=(
        "Write down the rotor's kinetic energy with the speed that the new gear gives it, and compare "
        "it with ½ (…) q̇²."
    ),
    further="The torque that the motor gives at the joint is only halved; the felt inertia falls more.",
    hints=(
        "How fast does the rotor turn when the joint turns at q̇?",
        "Put that speed into ½ J ω². The factor of ½ q̇² is what the joint feels.",
    ),
)


def _hands(rng, count):
    calls = []
    for n in rng.integers(3, 6, size=count):
        root = rng.normal(size=(n, n))
        e = rng.normal(size=3)
        arguments = (rng.normal(size=(3, n)), root @ root.T + np.eye(n), e / np.linalg.norm(e))
        calls.append(Call("my_feel", arguments))
    return calls


def _mobility(J, M):
    return J @ np.linalg.solve(M, J.T)


FEEL = Check(
    id="11-feel",
    signature="my_feel(J, M, e)",
    reference=lambda J, M, e: 1 / (e @ _mobility(J, M) @ e),
    calls=_hands,
    criteria=(Criterion("mass along e", "kg"),),
    mistakes=(
        Mistake(
            "on rails",
            lambda J, M, e: e @ np.linalg.inv(_mobility(J, M)) @ e,
            "This is the mass of a hand on rails along e. A free hand also moves aside: which "
            "component of its acceleration is asked for?",
        ),
        Mistake(
            "not inverted",
            lambda J, M, e: e @ _mobility(J, M) @ e,
            "This is the acceleration for a force of 1 N. A mass is force over acceleration.",
        ),
        Mistake(
            "M for its inverse",
            lambda J, M, e: 1 / (e @ J @ M @ J.T @ e),
            "You multiplied by M. Which matrix gives accelerations from torques?",
        ),
        Mistake(
            "M, not inverted",
            lambda J, M, e: e @ J @ M @ J.T @ e,
            "You carried M to the hand as if it were made of torques. Start from the force: which "
            "torques, then which accelerations, does it give?",
        ),
        Mistake(
            "whole acceleration",
            lambda J, M, e: 1 / np.linalg.norm(_mobility(J, M) @ e),
            "You took the size of the whole acceleration. Which component of it is asked for?",
        ),
    ),
    hints=(
        "Three steps: the joint torques of a force F e, the joint accelerations they give, and what "
        "these give at the hand along e.",
        "The transpose of J takes forces to torques, the inverse of M takes these to q̈, and J takes "
        "q̈ to the hand. Take the component along e, then divide.",
    ),
    further="Its square root, upside down, is the width of the ellipsoid of section 5 along e.",
)

WALL = Choice(
    id="11-wall",
    text="how many base parameters the arm on the wall has",
    options=(
        Option(
            "15, because the bodies are the same: how an arm is mounted changes nothing in them.",
            "The bodies are the same. Can gravity now turn a joint that it could not turn before?",
        ),
        Option(
            "16: the trunk's mass comes in, because a motor now has to carry it.",
            "The trunk turns about its axis. Which numbers of it say how its weight turns it: does a "
            "mass on the axis do so?",
        ),
        Option(
            "18: all three first moments of the trunk come in, because gravity acts on each of them.",
            "Gravity acts on each, but not each turns the joint. Move the trunk's centre of mass along "
            "the axis: does the torque change?",
        ),
        Option(
            "17: two first moments of the trunk come in, those across its axis, because $g_1$ is no "
            "longer zero.",
        ),
        Option(
            "25: all ten numbers of the trunk come in, because it is now a link like the others.",
            "The trunk still turns about one line that does not move. Which of its moments of inertia "
            "can such a motion show?",
        ),
    ),
    further="To identify the trunk's first moments, tilt the arm: upright, no motion shows them.",
    hints=(
        "The trunk still turns about one fixed line. What of it did the upright arm show?",
        "Its weight pulls across the axis now. Where must its centre of mass be for that to make no "
        "torque?",
    ),
)

CHECKS = (TRIANGLE, FLING, GEAR, FEEL, WALL)
