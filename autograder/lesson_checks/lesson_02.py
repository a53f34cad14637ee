"""The checks of lesson 02, from the Lagrangian to the matrices."""

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import UnfitError, each, vector
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("02-slide", "02-crank"),
    2: ("02-minus",),
    3: ("p2-C", "02-cart"),
    4: ("p2-christoffel",),
    5: ("02-torque",),
}

# A mass that slides along an arm: M11 = I + m q2², M22 = m. kg, m, rad/s, m/s.
SLIDING, OUT, TURN, SLIDE = 2.0, 0.6, 3.0, 0.4

FORCE = Number(
    id="02-slide",
    text="the force of the motor of joint 2",
    unit="N",
    right=-SLIDING * OUT * TURN**2,
    wrong=(
        WrongNumber(
            "sign",
            SLIDING * OUT * TURN**2,
            "The size is right. Left to itself, the mass flies outwards, to greater q2: which way must "
            "the motor pull to keep it from doing so?",
        ),
        WrongNumber(
            "without the half",
            -2 * SLIDING * OUT * TURN**2,
            "This is twice the right force. Which factor does line 3 take over from K?",
        ),
        WrongNumber(
            "none",
            0.0,
            "With no force the mass would fly outwards. M22 is constant, but of which entries of M does "
            "line 4 ask for the slopes?",
        ),
        WrongNumber(
            "the other joint",
            2 * SLIDING * OUT * TURN * SLIDE,
            "This is the torque that joint 1 needs. For which i did you write down line 4?",
        ),
        WrongNumber(
            "both velocities",
            -SLIDING * OUT * TURN * SLIDE,
            "You multiplied by both velocities. Which two does a term with the slope of M11 have?",
        ),
        WrongNumber(
            "not squared",
            -SLIDING * OUT * TURN,
            "You have one velocity in it. How many does each term of line 4 have?",
        ),
        WrongNumber(
            "no slope",
            -SLIDING * OUT**2 * TURN**2 / 2,
            "You put in the entry of M itself. Line 4 has slopes of M: what is the slope of q2²?",
        ),
    ),
    otherwise=(
        "This is not line 4 for joint 2. Which of the slopes of this M are not zero, and in which terms "
        "of the line do they stand?"
    ),
    further=(
        "It is mass times radius times turning rate squared, and points inwards: what keeps a mass on "
        "a circle."
    ),
    hints=(
        "Write down line 4 for i = 2. Most of the slopes of this M are zero: which is not?",
        "Only M11 changes, and only with q2. So which of the two terms in the brackets is left, and for "
        "which j and k?",
    ),
)

MINUS = Choice(
    id="02-minus",
    text="where the ½ and the minus of h come from",
    options=(
        Option(
            "The minus is chosen: it makes the centrifugal torque point outwards. The $\\tfrac12$ is "
            "that of $K$, in all three terms.",
            "Nothing was chosen by how it points. Go back to line 4: from which lines do its two terms "
            "come, and with which factors?",
        ),
        Option(
            "The minus is that of $-\\partial K/\\partial q_i$. The $\\tfrac12$ is that of $K$, in all "
            "three terms.",
            "The sign is explained. But what became of the ½ of K in line 1?",
        ),
        Option(
            "The minus is that of $-\\partial K/\\partial q_i$, and so is the $\\tfrac12$ of the third "
            "term. The first two have theirs from evening out one slope in $j$ and $k$.",
        ),
        Option(
            "The minus makes $h_{ijk} = h_{ikj}$. The $\\tfrac12$ is from evening out in $j$ and $k$, "
            "in all three terms.",
            "Exchange j and k in the third term: does h need its sign to stay the same? And which term "
            "did section 2 not have to even out?",
        ),
    ),
    further=(
        "Without the third term C q̇ would be the rate of M times q̇: d/dt of M q̇, before the slope of K "
        "is taken off."
    ),
    hints=(
        "Two lines of section 1 make line 4. Which terms come from which of them?",
        "The ½ of K is gone in line 1, as two equal sums add up. In line 3 it is still there.",
    ),
)


def _symbols(rng, count):
    """Symbols h_ijk that are symmetric in j and k, as all are, and velocities."""
    calls = []
    for _ in range(count):
        n = rng.integers(2, 5)
        h = rng.uniform(-2, 2, size=(n, n, n))
        calls.append(Call("my_torque", (h + h.transpose(0, 2, 1), rng.uniform(-3, 3, size=n))))
    return calls


@each
def _torques(call, value):
    n = len(call.args[1])
    if np.shape(value) == (n, n):
        raise UnfitError(
            f"an array of shape {(n, n)}, as C has; it must return shape ({n},), one torque for each "
            "joint"
        )
    return (vector(value, n),)


def _centrifugal(h, qd):
    return np.einsum("ijj,j->i", h, qd**2)


def _torque(h, qd):
    return h @ qd @ qd


TORQUE = Check(
    id="02-torque",
    signature="my_torque(h, qd)",
    reference=_torque,
    calls=_symbols,
    quantities=_torques,
    criteria=(Criterion("the velocity torques of all joints", "N·m"),),
    mistakes=(
        Mistake(
            "times ones",
            lambda h, qd: np.sum(h @ qd, axis=1),
            "You added up the rows of C. One velocity is in C: with what is C multiplied, so that it "
            "becomes a torque?",
        ),
        Mistake(
            "centrifugal alone",
            _centrifugal,
            "These are the centrifugal torques alone. What does a joint feel where two different joints "
            "move?",
        ),
        Mistake(
            "Coriolis alone",
            lambda h, qd: _torque(h, qd) - _centrifugal(h, qd),
            "These are the Coriolis torques alone. What does a joint feel where only one other joint "
            "moves?",
        ),
        Mistake(
            "each product once",
            lambda h, qd: (_torque(h, qd) + _centrifugal(h, qd)) / 2,
            "You have each product of two different velocities once. How often does it come in the "
            "double sum?",
        ),
        Mistake(
            "last index free",
            lambda h, qd: np.einsum("ijk,i,j->k", h, qd, qd),
            "Your last index is free. Which index of h names the joint that feels the torque?",
        ),
        Mistake(
            "halved",
            lambda h, qd: _torque(h, qd) / 2,
            "Your torques are half of the right ones. The ½ is in h already.",
        ),
        Mistake(
            "reversed",
            lambda h, qd: -_torque(h, qd),
            "The sign is reversed. The equation of motion has these torques on the left, beside M q̈.",
        ),
        Mistake(
            "squares alone",
            lambda h, qd: np.sum(h @ qd**2, axis=1),
            "You squared the velocity of k and left out that of j. What does h_ijk multiply?",
        ),
        Mistake(
            "without velocities",
            lambda h, qd: np.sum(h, axis=(1, 2)),
            "You added up the symbols. What do they multiply in the sums over j and k?",
        ),
    ),
    hints=(
        "For each i it is a double sum. `np.einsum` writes sums as you write indices, and `@` sums over "
        "the last index of what is on its left.",
        "The product `h @ qd` sums over k and gives a matrix: which one? One sum is still to come.",
    ),
    further=(
        "Twice as fast, it is four times as large: each of its terms is a product of two velocities."
    ),
)

CART = Choice(
    id="02-cart",
    text="which symbols of the cart with the pendulum are not zero",
    options=(
        Option(
            "$h_{122}$, $h_{212}$ and $h_{221}$: $M_{12}$ depends on $q_2$, so each joint feels the "
            "other one's velocity.",
            "M12 enters h_212 with two of its three derivatives. Write both down, with their signs.",
        ),
        Option(
            "$h_{122}$ alone: the slope of $M_{12}$ enters $h_{212}$ and $h_{221}$ twice, with a plus "
            "and a minus, so the pendulum does not feel the cart's speed.",
        ),
        Option(
            "$h_{122}$ and $h_{211}$: one slope of $M$ makes both, with opposite signs, as in the 2R "
            "arm.",
            "In the 2R arm h_211 comes from the slope of M11. What is M11 here?",
        ),
        Option(
            "None: the cart rolls along a straight line, and only what turns about something feels "
            "centrifugal forces.",
            "The pendulum turns. What must the rail and the cart do when its mass goes round the pivot?",
        ),
    ),
    further="In the frame of a cart that rolls steadily, a pendulum swings as it does in one at rest.",
    hints=(
        "Only one slope of this M is not zero. Which symbols have it in one of their three derivatives?",
        "Put ∂M12/∂q2 into the three derivatives of h_122, then into those of h_212.",
    ),
)

# One joint, whose inertia changes with its angle: kg·m², kg·m²/rad, rad/s.
INERTIA, SLOPE, RATE = 0.8, 0.3, 8.0

CRANK = Number(
    id="02-crank",
    text="the torque that keeps the one joint at constant speed",
    unit="N·m",
    right=SLOPE * RATE**2 / 2,
    wrong=(
        WrongNumber(
            "none",
            0.0,
            "M grows and the velocity stays, so the kinetic energy grows. Where does it come from, if "
            "there is no torque?",
        ),
        WrongNumber(
            "d/dt alone",
            SLOPE * RATE**2,
            "This is the rate of M q̇. What does Euler–Lagrange take off from it?",
        ),
        WrongNumber(
            "slope of K alone",
            -SLOPE * RATE**2 / 2,
            "This is the slope of K, with its minus. What does the rate of M q̇ add to it?",
        ),
        WrongNumber(
            "the entry of C",
            SLOPE * RATE / 2,
            "This is C itself. Which factor makes a torque of it?",
        ),
        WrongNumber(
            "rate of M",
            SLOPE * RATE,
            "This is how fast M changes, in kg·m²/s. A torque is in N·m.",
        ),
        WrongNumber(
            "momentum",
            INERTIA * RATE,
            "This is M q̇. The torque depends on how this changes, and on the slope of K.",
        ),
        WrongNumber(
            "energy",
            INERTIA * RATE**2 / 2,
            "This is the kinetic energy. Put its derivatives into Euler–Lagrange.",
        ),
    ),
    otherwise=(
        "This is not what Euler–Lagrange gives. With one joint, each of the lines of section 1 has one "
        "term: write down lines 2 and 3."
    ),
    further=(
        "Its power, torque times velocity, is the rate at which the kinetic energy grows with M."
    ),
    hints=(
        "Section 1 holds for one joint too. What are lines 2 and 3 there, if q̈ = 0?",
        "Or take the power: torque times velocity must be the rate of ½ M q̇², in which only M changes.",
    ),
)

CHECKS = (FORCE, MINUS, TORQUE, CART, CRANK)
