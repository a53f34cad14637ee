"""Mistakes about gravity: in P, in its gradient, in the form with Jacobians, in the equilibria."""

from math import pi
from types import SimpleNamespace

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.material import sentences

# The arm of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.38, lc1=0.21, lc2=0.17, m1=4.2, m2=2.6, I1=0.075, I2=0.034, g=9.81
)

HARD_CODED_G = (
    "Your answer is right only on Earth, because you typed 9.81 into it. The check also puts the "
    "arm on other planets: which parameter of arm gives g?"
)
EXAMPLE_ARM = (
    "You always use the numbers of the arm in the set-up cell, whatever arm is given. Where does "
    "your function read the parameters of its own argument?"
)
LINK_1_LENGTH = (
    "You let the weight of link 1 act at its end. Which of l1 and lc1 leads to the centre of mass "
    "of link 1?"
)
LINK_2_LENGTH = (
    "You let the weight of link 2 act at its tip. Which of l2 and lc2 leads to the centre of mass "
    "of link 2?"
)
ELBOW_AT_LC1 = (
    "You let link 2 begin at the centre of mass of link 1. Where on link 1 is the elbow, and which "
    "parameter says so?"
)
MASSES_MISSING = "The masses are missing. What is the weight of a link?"
MASSES_SWAPPED = "You swapped m1 and m2. Which mass belongs to which link?"
G_MISSING = "The gravitational acceleration g is missing. What is the weight of a link?"

POTENTIAL_SAID = {
    "numbers of the example": EXAMPLE_ARM,
    "sign of the whole": (
        "Your P has the wrong sign: it falls as the arm rises. Which way does the gravitational "
        "acceleration point, and does it take work to lift a link?"
    ),
    "cosine for sine": (
        "Your P uses cosines. They tell how far out the links reach, or how high, if the angles "
        "were measured from upright. From which axis is q1 measured, and how high is link 1 at q1 "
        "= 0?"
    ),
    "cosine for sine / −": (
        "Your P measures the angles from hanging down, as problem 3 does for the pendulum. From "
        "which axis is q1 measured here, and how high is link 1 at q1 = 0?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2": (
        "Your P takes q2 for the direction of link 2 in space. From where is q2 measured?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q1 − q2 / q1 + q2": (
        "Your P takes the difference of the angles for the direction of link 2. Turn the elbow a "
        "little counter-clockwise: does link 2's angle with the x axis grow or shrink?"
    ),
    "dropped / the weight of link 2 beyond the elbow": (
        "Your P does not change as the elbow turns, as if the whole mass of link 2 sat at the "
        "elbow or were left out. Where is its centre of mass?"
    ),
    "dropped / the weight of link 2 at the elbow": (
        "In your P, link 2 begins at the height of the shoulder. How high is the elbow, where it "
        "really begins?"
    ),
    "dropped / the weight of link 1 beyond the shoulder": (
        "Your P leaves out the weight of link 1. How high is the centre of mass of link 1?"
    ),
    "wrong parameter / the weight of link 1 beyond the shoulder / l1 / lc1": LINK_1_LENGTH,
    "wrong parameter / the weight of link 2 beyond the elbow / l2 / lc2": LINK_2_LENGTH,
    "wrong parameter / the weight of link 2 at the elbow / lc1 / l1": ELBOW_AT_LC1,
    "half of the whole": (
        "Your P is half the right one. A ½ belongs to a kinetic energy: does it belong here?"
    ),
    "parameters exchanged / m1 / m2": MASSES_SWAPPED,
    "parameter left out / g": G_MISSING,
    "gravity of Earth / 9.81 / g": HARD_CODED_G,
    "radians converted": sentences.RADIANS_CONVERTED,
    "angle in degrees": sentences.IN_DEGREES,
    "kind left out / kg": MASSES_MISSING,
}

GRAVITY_SAID = {
    "numbers of the example": EXAMPLE_ARM,
    "sign of the whole": (
        "Your gravity torque has the wrong sign. On which side of M q̈ + C q̇ + g = u does g stand, "
        "and which way must a motor push to hold the arm out to the right?"
    ),
    "sine for cosine": (
        "You have the sine where the cosine belongs: your arm feels no gravity when its links are "
        "level. Have you differentiated P, and from which axis is q1 measured?"
    ),
    "sine for cosine / −": (
        "Your torque varies like −sin, as the gradient of a P made of cosines does. From which axis "
        "is q1 measured, and what is the height of link 1 at q1 = 0?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2": (
        "You take q2 for the direction of link 2 in space. From where is q2 measured?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q1 − q2 / q1 + q2": (
        "You take the difference of the angles for the direction of link 2. Turn the elbow a "
        "little counter-clockwise: does link 2's angle with the x axis grow or shrink?"
    ),
    "dropped / the weight of link 2 beyond the elbow / g1": (
        "Your g1 lacks the term with the direction of link 2. Does that direction change when "
        "joint 1 turns and q2 stays the same?"
    ),
    "dropped / the weight of link 2 at the elbow": (
        "Your g1 leaves out the weight of m2 at the elbow. What does joint 1 carry besides its "
        "own link?"
    ),
    "dropped / the weight of link 1 beyond the shoulder": (
        "Your g1 leaves out the weight of link 1. What does joint 1 carry besides link 2?"
    ),
    "joints exchanged": (
        "You swapped the torques of the two joints. Which joint carries both links?"
    ),
    "wrong parameter / the weight of link 1 beyond the shoulder / l1 / lc1": LINK_1_LENGTH,
    "wrong parameter / the weight of link 2 beyond the elbow / l2 / lc2": LINK_2_LENGTH,
    "wrong parameter / the weight of link 2 at the elbow / lc1 / l1": ELBOW_AT_LC1,
    "parameters exchanged / m1 / m2": MASSES_SWAPPED,
    "parameter left out / g": G_MISSING,
    "gravity of Earth / 9.81 / g": HARD_CODED_G,
    "radians converted": sentences.RADIANS_CONVERTED,
    "angle in degrees": sentences.IN_DEGREES,
    "astray / the weight of link 2 at the elbow / g2 / g1": (
        "Your g2 is the torque of link 2's weight about the shoulder. About which axis does "
        "joint 2 turn, and does the elbow move with q2?"
    ),
    "energy for its derivative": (
        "You return the potential energy P, in joules. What turns P(q) into g(q)?"
    ),
    "kind left out / kg": MASSES_MISSING,
}
GRAVITY = (
    Mistake(
        "energies of the links",
        lambda q, arm: np.array(
            [
                arm.m1 * arm.g * arm.lc1 * np.sin(q[0]),
                arm.m2 * arm.g * (arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])),
            ]
        ),
        "You return the potential energies of the two links. What turns P(q) into g(q)?",
    ),
)


def _from_jacobians(jacobians_v, masses, g0) -> np.ndarray:
    """−Σ m Jvᵀ g0, (n,), N·m."""
    return -np.einsum("l,lin,i->n", masses, jacobians_v, g0)


def _gravity(change):
    """The right formula with another g0."""
    return lambda jacobians_v, masses, g0: _from_jacobians(jacobians_v, masses, change(g0))


def _masses(change):
    """The right formula with other masses."""
    return lambda jacobians_v, masses, g0: _from_jacobians(jacobians_v, change(masses), g0)


def _but_for(place, kept=0.0, others=1.0):
    """The masses times these numbers: the one at this place, and the others."""
    return _masses(lambda m: m * np.where(np.arange(len(m)) == place % len(m), kept, others))


def _reshaped(jacobians_v, masses, g0):
    L, _, n = jacobians_v.shape
    return -masses @ (jacobians_v.reshape(L, n, 3) @ g0)


_, Y, Z = np.eye(3)
LENGTH_OF_G0 = (
    "You use only the length of g0 and let gravity point straight along one axis. What does the "
    "direction of the vector g0 tell you?"
)
ONE_COMPONENT = (
    "You use only one component of g0. A robot may hang on a wall or on a slope: which components "
    "of g0 do work when a centre of mass moves?"
)
EARTH = (
    "You typed 9.81 into your function. Which argument tells how strong gravity is, and where it "
    "points?"
)
LOADS = (
    "You add up the masses along the chain. Each Jacobian belongs to one centre of mass: how many "
    "links have their mass there?"
)

# What stands for g0, with the sentence.
STRENGTHS = {
    "length of g0 against y": (lambda g0: -np.linalg.norm(g0) * Y, LENGTH_OF_G0),
    "length of g0 against z": (lambda g0: -np.linalg.norm(g0) * Z, LENGTH_OF_G0),
    "length of g0 along y": (lambda g0: np.linalg.norm(g0) * Y, LENGTH_OF_G0),
    "length of g0 along z": (lambda g0: np.linalg.norm(g0) * Z, LENGTH_OF_G0),
    "y component alone": (lambda g0: g0 * Y, ONE_COMPONENT),
    "z component alone": (lambda g0: g0 * Z, ONE_COMPONENT),
    "9.81 against y": (lambda g0: -9.81 * Y, EARTH),
    "9.81 against z": (lambda g0: -9.81 * Z, EARTH),
    "9.81 along g0": (lambda g0: 9.81 * g0 / np.linalg.norm(g0), EARTH),
    "direction of g0 alone": (
        lambda g0: g0 / np.linalg.norm(g0),
        "You use only the direction of g0. How strong is gravity?",
    ),
}

TURNED = "Its sign is wrong as well: g0 points down, and P grows upwards."

FROM_JACOBIANS = (
    Mistake(
        "sign of gravity",
        _gravity(lambda g0: -g0),
        "Your gravity torque has the wrong sign. g0 points down: does P grow or fall when a "
        "centre of mass moves along g0?",
    ),
    *(Mistake(name, _gravity(g0), sentence) for name, (g0, sentence) in STRENGTHS.items()),
    Mistake(
        "masses ignored",
        _masses(np.ones_like),
        "You leave out the masses. What turns the acceleration g0 into a force on a link?",
    ),
    Mistake("masses added up from the base", _masses(np.cumsum), LOADS),
    Mistake("masses added up from the hand", _masses(lambda m: np.cumsum(m[::-1])[::-1]), LOADS),
    Mistake(
        "total mass at every link",
        _masses(lambda m: np.full_like(m, m.sum())),
        "You put the mass of the whole robot at every centre of mass. Which mass belongs to which "
        "Jacobian?",
    ),
    Mistake("first link left out", _but_for(0), sentences.FIRST_LINK_LEFT_OUT),
    Mistake("last link left out", _but_for(-1), sentences.LAST_LINK_LEFT_OUT),
    Mistake("last link alone", _but_for(-1, kept=1.0, others=0.0), sentences.LAST_LINK_ONLY),
    Mistake("first link alone", _but_for(0, kept=1.0, others=0.0), sentences.FIRST_LINK_ONLY),
    Mistake(
        "first link alone, sign of gravity",
        _but_for(0, kept=-1.0, others=0.0),
        f"{sentences.FIRST_LINK_ONLY} {TURNED}",
    ),
    Mistake(
        "last link alone, sign of gravity",
        _but_for(-1, kept=-1.0, others=0.0),
        f"{sentences.LAST_LINK_ONLY} {TURNED}",
    ),
    Mistake(
        "first two links alone",
        _masses(lambda m: m * (np.arange(len(m)) < 2)),
        "Your result holds only the first two links. The check also asks about robots with more: which "
        "argument tells how many there are?",
    ),
    Mistake(
        "mean for sum",
        _masses(lambda m: m / len(m)),
        "You divide by the number of links. Is the potential energy of the robot the mean of the links' "
        "energies, or their sum?",
    ),
    Mistake("reshaped for transposed", _reshaped, sentences.RESHAPED),
)


def _all(first, second):
    """Every pair of one angle from each."""
    return lambda arm: np.array([(a, b) for a in first for b in second])


def _only(*configurations):
    return lambda arm: np.array(configurations)


LEVEL = (
    "Your configurations hold the links level, where gravity pulls hardest. From which axis is q1 "
    "measured? Which must vanish: P, or its gradient?"
)
STRETCHED = (
    "Your configurations are equilibria, but in all of them the arm is stretched. Must both links "
    "point the same way for both torques to vanish?"
)
# Folded back, the same torques and distances come out: one model stands for both.
QUARTER = (
    "You fold the elbow by a quarter turn. Link 2 then lies level and pulls on both joints. How "
    "far must the elbow turn from stretched to folded?"
)
DEGREES = "Your angles are correct, but in degrees. In which unit must you give them?"

EQUILIBRIA = (
    Mistake("stretched only", _only((pi / 2, 0), (-pi / 2, 0)), STRETCHED),
    Mistake(
        "stable only",
        _only((-pi / 2, 0)),
        "Your answer holds only the arm hanging down. An equilibrium need not be stable: where "
        "else do both torques vanish?",
    ),
    Mistake(
        "one value of the inverse cosine",
        _only((pi / 2, 0)),
        "Your answer holds only the arm standing upright. An inverse cosine gives one angle: how "
        "many angles on the circle have this cosine?",
    ),
    Mistake(
        "link 1 up only",
        _only((pi / 2, 0), (pi / 2, pi)),
        "Your configurations are equilibria, but in all of them link 1 points up. In which other "
        "direction does link 1 need no torque?",
    ),
    Mistake(
        "link 1 down only",
        _only((-pi / 2, 0), (-pi / 2, pi)),
        "Your configurations are equilibria, but in all of them link 1 hangs down. In which other "
        "direction does link 1 need no torque?",
    ),
    Mistake("from the vertical", _all((0, pi), (0, pi)), LEVEL),
    Mistake("from the vertical, stretched only", _only((0, 0), (pi, 0)), LEVEL),
    Mistake(
        "absolute second angle",
        _all((-pi / 2, pi / 2), (-pi / 2, pi / 2)),
        "Your second angle is the direction of link 2 in space. From where is q2 measured?",
    ),
    Mistake("folded by a quarter turn", _all((-pi / 2, pi / 2), (0, pi / 2)), QUARTER),
    Mistake(
        "in degrees",
        _all((-90, 90), (0, 180)),
        DEGREES,
    ),
)
