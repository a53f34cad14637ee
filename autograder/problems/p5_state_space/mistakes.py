"""Mistakes about the first-order form."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.terms import Term
from autograder.problems.material.planar_2r import C, M, f_vec, g_vec

# The arm of the notebook; a test holds the two together.
EXAMPLE = SimpleNamespace(
    l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=2.0, m2=1.5, I1=0.17, I2=0.08, g=9.81,
    viscous=np.array([0.3, 0.2]), coulomb=np.array([0.4, 0.25]),
)  # fmt: skip


def torque(q, qd, u, arm):
    """What is left of u to accelerate the arm, (2,), N·m."""
    return u - C(q, qd, arm) @ qd - g_vec(q, arm) - f_vec(qd, arm)


def rate(x, u, arm):
    """ẋ of the arm, (4,): the right answer."""
    q, qd = x[:2], x[2:]
    return np.concatenate([qd, np.linalg.solve(M(q, arm), torque(q, qd, u, arm))])


def _part(torque_of):
    """A term of q̈: M⁻¹ times a torque."""

    def model(x, u, arm):
        q, qd = x[:2], x[2:]
        part = np.linalg.solve(M(q, arm), torque_of(q, qd, u, arm))
        return np.concatenate([np.zeros(2), part])

    return model


RATE_TERMS = (
    Term("M⁻¹ u", _part(lambda q, qd, u, arm: u)),
    Term("M⁻¹ C q̇", _part(lambda q, qd, u, arm: -C(q, qd, arm) @ qd)),
    Term("M⁻¹ g", _part(lambda q, qd, u, arm: -g_vec(q, arm))),
    Term("viscous friction", _part(lambda q, qd, u, arm: -arm.viscous * qd)),
    Term("Coulomb friction", _part(lambda q, qd, u, arm: -arm.coulomb * np.sign(qd))),
)

INTERLEAVED = (
    "You read x as if it were [q1, q̇1, q2, q̇2]. In which order does the notation table put the "
    "four entries?"
)
SMOOTH_SIGN = (
    "Your Coulomb friction fades out at low speed, as a tanh does. In this model it jumps: how "
    "large is dry friction at 0.001 rad/s?"
)
AT_REST = (
    "Your Coulomb friction is not zero in a joint at rest. In which direction would it push there? "
    "What does NumPy's own sign give for 0?"
)

RATE_SAID = {
    "halves of ẋ swapped": (
        "You swapped the two halves of ẋ. Which half of x is q, and which half of ẋ is its rate "
        "of change?"
    ),
    "q for its rate": (
        "The first half of your ẋ is q itself. What is the rate of change of q, and where in x "
        "does it stand?"
    ),
    "state read as q̇ and q": (
        "Your accelerations come out as if x were [q̇; q]. Which half of x do you call q?"
    ),
    "state interleaved": INTERLEAVED,
    "states interleaved": INTERLEAVED,
    "dropped / C q̇": (
        "The Coriolis and centrifugal torque is missing from your q̈. Which term of the "
        "equation of motion is quadratic in the velocities?"
    ),
    "wrong sign / C q̇": (
        "The Coriolis and centrifugal torque has the wrong sign in your q̈. On which side of "
        "the equation of motion does it stand?"
    ),
    "C times ones in the torque": (
        "Your Coriolis torque is the sum of each row of C. What must C multiply?"
    ),
    "transposed / in C": (
        "Your Coriolis torque uses C with its rows and columns swapped. Does q̇ stand to the "
        "right or to the left of C?"
    ),
    "dropped / g(q)": (
        "Gravity is missing from your q̈. Which torque acts on the arm when it is at rest?"
    ),
    "wrong sign / g(q)": (
        "Gravity has the wrong sign in your q̈: your arm falls upwards. On which side of the "
        "equation of motion does g(q) stand?"
    ),
    "gravity of Earth / 9.81 / g / in g_vec": (
        "Your q̈ is right only on Earth, because you typed 9.81 into it. The check also uses "
        "other planets: which parameter of arm gives g?"
    ),
    "dropped / the friction": (
        "Friction is missing from your q̈. Which two parameters of arm have you not used yet?"
    ),
    "wrong sign / the friction": (
        "Friction has the wrong sign in your q̈: it drives the joints. Does friction add energy "
        "to an arm or take it out?"
    ),
    "dropped / the viscous friction": (
        "The viscous part of the friction is missing. Which part of f grows with the speed?"
    ),
    "wrong sign / the viscous friction": (
        "The viscous part of your friction has the wrong sign: the faster a joint moves, the "
        "harder it is pushed on. Must friction speed a joint up or slow it down?"
    ),
    "quadratic friction / the viscous friction": (
        "Your viscous friction grows with the square of the speed. Look at the unit of its "
        "coefficient."
    ),
    "dropped / the Coulomb friction": (
        "The Coulomb part of the friction is missing. Which part of f has the same size at "
        "every speed?"
    ),
    "wrong sign / the Coulomb friction": (
        "The Coulomb part of your friction has the wrong sign: it pushes the joint on. Must "
        "friction speed a joint up or slow it down?"
    ),
    "friction in one direction / the Coulomb friction": (
        "Your Coulomb friction always acts in the same direction. What decides the direction of "
        "friction?"
    ),
    "absolute value for sign / the Coulomb friction": (
        "Your Coulomb friction uses |q̇| where the sign of q̇ belongs: it grows with the speed "
        "and never changes direction."
    ),
    "velocity for its sign / the Coulomb friction": (
        "Your Coulomb friction grows with the speed. Dry friction does not depend on how fast a "
        "joint moves: what does it depend on?"
    ),
    "sign of the coordinate / the Coulomb friction": (
        "Your Coulomb friction has the sign of the angle. Does friction depend on where a joint "
        "is, or on how it moves?"
    ),
    "smooth sign / the Coulomb friction / *": SMOOTH_SIGN,
    "friction at rest / the Coulomb friction / *": AT_REST,
    "coefficients exchanged / the friction": (
        "You swapped the two friction coefficients. Which of them is in N·m, and which in "
        "N·m·s/rad?"
    ),
    "not divided by M / the friction": (
        "You subtract the friction from the acceleration. Friction is a torque: how does a "
        "torque become an acceleration?"
    ),
    "dropped / the input u": (
        "The input u is missing from your q̈. What makes the arm move where you want it to?"
    ),
    "wrong sign / the input u": (
        "The input u has the wrong sign in your q̈: the motor turns the wrong way. On which "
        "side of the equation of motion does u stand?"
    ),
    "M not inverted": ("You multiply by M. In M q̈ = …, how do you get q̈ alone?"),
    "torque for acceleration": ("The second half of your ẋ is a torque, in N·m. What resists it?"),
    "divided by the diagonal of M": (
        "You divide by the diagonal of M, as if the joints did not feel each other. What do the "
        "other entries do?"
    ),
    "entries of M inverted": (
        "You invert each entry of M by itself, which does not invert the matrix. Which NumPy "
        "function solves a linear system?"
    ),
    "divided by M entry by entry": (
        "You divide by M entry by entry. Which NumPy function solves a linear system?"
    ),
    "numbers of the example": (
        "Your f always uses the arm of this notebook. The check passes other arms to f: in which "
        "argument do they come?"
    ),
}
